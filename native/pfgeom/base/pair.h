// Two doubles in one register, which every machine that we build for adds and multiplies at once. Each of
// them gets the bits that it would get alone.
#pragma once

namespace pfgeom {

using Pair = double __attribute__((vector_size(16)));

/// What is not above zero, and what is not a number, becomes zero.
inline Pair positive(const Pair& a) {
    const Pair zero{};
    return a > zero ? a : zero;
}

}  // namespace pfgeom
