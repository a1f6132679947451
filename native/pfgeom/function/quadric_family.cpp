#include "pfgeom/function/quadric_family.h"

#include <cmath>

namespace pfgeom {
namespace {

constexpr std::uint16_t A = 1, B = 2, C = 4, D = 8, E = 16, F = 32, G = 64, H = 128, I = 256, K = 512;

using Kind = FamilyKind;

constexpr std::array<QuadricFamily, kQuadricFamilies> kFamilies{{
    {"plane across x", Kind::axis_plane, 2, {G, K}},
    {"plane across y", Kind::axis_plane, 2, {H, K}},
    {"plane across z", Kind::axis_plane, 2, {I, K}},
    {"plane", Kind::plane, 4, {G, H, I, K}},
    {"round cylinder along z", Kind::round, 4, {A | B, G, H, K}},
    {"round cylinder along y", Kind::round, 4, {A | C, G, I, K}},
    {"round cylinder along x", Kind::round, 4, {B | C, H, I, K}},
    {"sphere", Kind::round, 5, {A | B | C, G, H, I, K}},
    {"revolution around z", Kind::revolution, 6, {A | B, C, G, H, I, K}},
    {"revolution around y", Kind::revolution, 6, {A | C, B, G, H, I, K}},
    {"revolution around x", Kind::revolution, 6, {B | C, A, G, H, I, K}},
    {"conic cylinder along z", Kind::revolution, 6, {A, B, D, G, H, K}},
    {"conic cylinder along y", Kind::revolution, 6, {A, C, E, G, I, K}},
    {"conic cylinder along x", Kind::revolution, 6, {B, C, F, H, I, K}},
    {"axes-parallel quadric", Kind::general, 7, {A, B, C, G, H, I, K}},
    {"general quadric", Kind::general, 10, {A, B, C, D, E, F, G, H, I, K}},
}};

}  // namespace

std::span<const QuadricFamily, kQuadricFamilies> quadric_families() {
    return kFamilies;
}

Quadric expand(const TreeQuadric& quadric, int resolution) {
    const QuadricFamily& family = kFamilies[quadric.family];
    Quadric q;
    for (int i = 0; i < family.size; ++i) {
        const int degree = family.degree(i);
        int exponent = resolution;
        if (degree >= 1) exponent -= quadric.linear_shift;
        if (degree == 2) exponent -= quadric.square_shift;
        if (family.kind == Kind::axis_plane && degree == 1) exponent = 0;
        const auto at = static_cast<std::size_t>(i);
        const double value = std::ldexp(static_cast<double>(quadric.n[at]), -exponent);
        for (std::size_t j = 0; j < q.c.size(); ++j) {
            if ((family.terms[at] >> j & 1U) != 0) q.c[j] = value;
        }
    }
    return q;
}

}  // namespace pfgeom
