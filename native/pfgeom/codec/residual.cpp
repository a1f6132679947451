#include "pfgeom/codec/residual.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

constexpr std::uint32_t kZero = 0, kSign = 1, kExponent = 2, kMantissa = 3;

}  // namespace

std::uint32_t half_octaves(double x) {
    const double sixteenths = std::min(x, 1e8) * 16;
    return static_cast<std::uint32_t>(log2_sixteenths(static_cast<std::uint32_t>(sixteenths))) / 8;
}

std::int32_t code_residual(EntropyCoder& coder, ContextMixer& mixer, std::int32_t value,
                           const ResidualHint& hint) {
    const auto where = [&](std::uint32_t part, std::uint32_t set) {
        return ContextMixer::Where{hint.kind + part, set, hint.scale};
    };
    const std::uint32_t joint = hint.scale * 64 + hint.recent;
    const std::uint32_t extra = hint.extra;
    const std::array<std::uint32_t, 4> zero{hint.scale, hint.recent, joint, extra};
    if (mixer.code(coder, value != 0 ? 1 : 0, where(kZero, 0), zero) == 0) return 0;
    const std::array<std::uint32_t, 2> sign{0, extra};
    const bool negative = mixer.code(coder, value < 0 ? 1 : 0, where(kSign, 0), sign) != 0;

    const auto magnitude = static_cast<std::uint32_t>(std::abs(value));
    std::uint32_t e = 0;
    for (; e < 29; ++e) {
        const std::uint32_t more = magnitude >> (e + 1) != 0 ? 1 : 0;
        const std::array<std::uint32_t, 5> contexts{e, e * 64 + hint.scale, e * 64 + hint.recent,
                                                    e * 4096 + joint, e * 64 + extra};
        if (mixer.code(coder, static_cast<int>(more), where(kExponent, e), contexts) == 0) break;
    }
    std::uint32_t result = 1;
    for (std::uint32_t i = e; i-- > 0;) {
        const int in = static_cast<int>((magnitude >> i) & 1U);
        const std::uint32_t low = std::min(i, 3U);
        const std::uint32_t high = e - i <= 2 ? e * 4 + (result & 3U) : 128;
        const std::array<std::uint32_t, 3> contexts{low, high, 256 + high * 4 + low};
        result = (result << 1) |
                 static_cast<std::uint32_t>(mixer.code(coder, in, where(kMantissa, low), contexts));
    }
    return negative ? -static_cast<std::int32_t>(result) : static_cast<std::int32_t>(result);
}

}  // namespace pfgeom
