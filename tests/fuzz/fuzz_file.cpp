// Whole files. An input that does not begin with the magic is taken for a stream, so that mutations reach the
// decoders of functions and objects without having to get the lengths right.
#include "pfgeom/codec/codec.h"
#include "pfgeom/codec/header.h"

#include <algorithm>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::span<const std::uint8_t> bytes(data, size);
    std::vector<std::uint8_t> wrapped;
    if (size < pfgeom::kMagic.size() || !std::equal(pfgeom::kMagic.begin(), pfgeom::kMagic.end(), data)) {
        const auto version = static_cast<std::uint8_t>(pfgeom::kFirstVersion + size % 2);
        wrapped = pfgeom::seal_envelope(bytes, {}, version);
        bytes = wrapped;
    }
    const auto model = pfgeom::decode(bytes);
    if (!model) return 0;
    // A model is one that can be written, and then stays as it is.
    const auto again = pfgeom::encode(*model);
    const auto second = pfgeom::decode(again);
    if (!second || pfgeom::encode(*second) != again) std::abort();
    return 0;
}
