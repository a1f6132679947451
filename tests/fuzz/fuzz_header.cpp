// The outside of a file and its optional sections.
#include "pfgeom/codec/sections.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto envelope = pfgeom::open_envelope({data, size}, {});
    if (!envelope) return 0;
    pfgeom::Model model;
    if (pfgeom::read_sections(*envelope, size * 4096, model) != pfgeom::FormatStatus::ok) return 0;
    // What was understood is written as it was read, but for unknown sections.
    const auto sections = pfgeom::write_sections(model);
    const auto again = pfgeom::seal_envelope(envelope->stream, sections, envelope->version);
    if (again.size() > size || sections.size() != envelope->sections.size()) std::abort();
    if (!pfgeom::open_envelope(again, {})) std::abort();
    return 0;
}
