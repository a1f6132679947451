#include "pfgeom/render/ellipsoid_box.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {

// With q = K + g·p - p·M p the ellipsoid is (p - c)·M (p - c) <= k, where 2 M c = g and k = q(c): in
// direction e it reaches sqrt(k e·M⁻¹ e) from its centre.
std::optional<Box> ellipsoid_box(const Quadric& q) {
    const double a = -q.c[0], b = -q.c[1], c = -q.c[2], d = -q.c[3] / 2, e = -q.c[4] / 2, f = -q.c[5] / 2;
    const Vec3 diagonal{b * c - f * f, a * c - e * e, a * b - d * d};  // of M's adjugate
    const Vec3 mixed{e * f - d * c, d * f - e * b, d * e - a * f};     // xy, xz, yz
    const double determinant = a * diagonal.x + d * mixed.x + e * mixed.y;
    const double size = std::max({std::abs(a), std::abs(b), std::abs(c)});
    // Rounding takes 1e-16 of the largest products: there are nine digits left of what decides.
    constexpr double kClear = 1e-7;
    if (!(a > kClear * size && diagonal.z > kClear * size * size &&
          determinant > kClear * size * size * size && std::isfinite(determinant)))
        return {};
    const Vec3 g = q.gradient({});
    const Vec3 centre = Vec3{diagonal.x * g.x + mixed.x * g.y + mixed.y * g.z,
                             mixed.x * g.x + diagonal.y * g.y + mixed.z * g.z,
                             mixed.y * g.x + mixed.z * g.y + diagonal.z * g.z} /
                        (2 * determinant);
    const double k = q.value(centre) / determinant;
    if (!(k > 0) || !is_finite(centre)) return {};
    constexpr double kMargin = 1e-6;
    const Vec3 reach =
        Vec3{std::sqrt(k * diagonal.x), std::sqrt(k * diagonal.y), std::sqrt(k * diagonal.z)} * (1 + kMargin);
    return Box{centre - reach, centre + reach};
}

}  // namespace pfgeom
