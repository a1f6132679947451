// What is left of a number after its prediction.
#pragma once

#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mixer.h"

#include <cstdint>

namespace pfgeom {

/// What to expect of a residual; each but the kind is below 64.
struct ResidualHint {
    std::uint32_t kind;    ///< of the mixer; it and the three after it are this residual's
    std::uint32_t scale;   ///< how large it may well be
    std::uint32_t recent;  ///< how large its neighbours were
    std::uint32_t extra;
};

/// Zero, sign, exponent and mantissa.
std::int32_t code_residual(EntropyCoder& coder, ContextMixer& mixer, std::int32_t value,
                           const ResidualHint& hint);

/// log2(1 + x) in half octaves, x >= 0 in steps.
std::uint32_t half_octaves(double x);

}  // namespace pfgeom
