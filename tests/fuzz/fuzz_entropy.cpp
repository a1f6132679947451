// Entropy coder and mixer alone: any bytes decode to bits; the bits, written again, decode to themselves, and
// are the same bytes if the stream was one that the coder could have written.
#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mixer.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace {

// A walk of bits and integers whose contexts, features and kinds depend on what came before.
class Walk {
  public:
    Walk(pfgeom::EntropyCoder& coder, std::vector<std::uint32_t>& values) : coder_(coder), values_(values) {}

    // `form` says how often which symbol occurs.
    void run(std::uint8_t form, std::size_t count) {
        for (std::size_t i = 0; i < count && !coder_.exhausted(); ++i) {
            std::uint32_t value = coder_.decoding() ? 0 : values_[i];
            switch ((form + i * (1 + form / 16)) % 5) {
                case 0:
                    value = bit(value, 2);
                    break;
                case 1:
                    value = bit(value, 9);
                    break;
                case 2:
                    value = mixer_.code_uint(coder_, value, 200, state_ % 64);
                    break;
                case 3:
                    value = coder_.code_raw(value, static_cast<int>(state_ % 33));
                    break;
                default:
                    value = static_cast<std::uint32_t>(coder_.code(static_cast<int>(value), state_ % 65537));
                    break;
            }
            if (coder_.decoding())
                values_.push_back(value);
            else if (value != values_[i])
                std::abort();
            state_ = state_ * 1664525U + value * 22695477U + 1013904223U;
        }
    }

  private:
    std::uint32_t bit(std::uint32_t value, std::size_t contexts) {
        std::array<std::uint32_t, 9> all;
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = (state_ >> k) % (1U << (4 + 2 * k));
        const std::array<int, 3> features{static_cast<int>(state_ % 16384) - 8192, 512, -8192};
        return static_cast<std::uint32_t>(
            mixer_.code(coder_, static_cast<int>(value),
                        {static_cast<std::uint32_t>(contexts), state_ % 4096, state_ / 4096 % 4096},
                        std::span(all).first(contexts), features));
    }

    pfgeom::EntropyCoder& coder_;
    std::vector<std::uint32_t>& values_;
    pfgeom::ContextMixer mixer_;
    std::uint32_t state_ = 1;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::size_t count = data[1];
    const std::span<const std::uint8_t> stream(data + 2, size - 2);
    std::vector<std::uint32_t> values;
    pfgeom::EntropyCoder reader(stream);
    Walk(reader, values).run(data[0], count);
    if (reader.exhausted()) return 0;

    pfgeom::EntropyCoder writer;
    Walk(writer, values).run(data[0], count);
    const auto again = writer.finish();
    if (reader.ended_cleanly() != std::ranges::equal(again, stream)) std::abort();

    std::vector<std::uint32_t> same;
    pfgeom::EntropyCoder second(again);
    Walk(second, same).run(data[0], count);
    if (same != values || !second.ended_cleanly()) std::abort();
    return 0;
}
