#include "pfgeom/segment/ellipsoid.h"

#include <cmath>

namespace pfgeom {
namespace {

// Of the largest coefficient: what is less definite than this is a cylinder as far as rounding can tell.
constexpr double kLeastPivot = 1e-7;

}  // namespace

// With q = s (k - (x - c)ᵀ P (x - c)) and P = L Lᵀ the axes are the columns of √k L⁻ᵀ.
std::optional<Ellipsoid> ellipsoid_of(const Quadric& q) {
    const double s = q.c[0] < 0 ? 1 : -1;
    const double a = -s * q.c[0], b = -s * q.c[1], c = -s * q.c[2];
    const double d = -s * q.c[3] / 2, e = -s * q.c[4] / 2, f = -s * q.c[5] / 2;
    const double least = kLeastPivot * std::max({a, b, c});
    if (!(a > least)) return {};
    const double l11 = std::sqrt(a), l21 = d / l11, l31 = e / l11;
    const double m22 = b - l21 * l21;
    if (!(m22 > least)) return {};
    const double l22 = std::sqrt(m22), l32 = (f - l31 * l21) / l22;
    const double m33 = c - l31 * l31 - l32 * l32;
    if (!(m33 > least)) return {};
    const double l33 = std::sqrt(m33);

    const double y1 = s * q.c[6] / 2 / l11, y2 = (s * q.c[7] / 2 - l21 * y1) / l22;
    const double y3 = (s * q.c[8] / 2 - l31 * y1 - l32 * y2) / l33;
    Ellipsoid result;
    result.centre.z = y3 / l33;
    result.centre.y = (y2 - l32 * result.centre.z) / l22;
    result.centre.x = (y1 - l21 * result.centre.y - l31 * result.centre.z) / l11;
    const double k = s * q.value(result.centre);
    if (!(k > 0)) return {};
    const double r = std::sqrt(k);
    result.axes[0] = {r / l11, 0, 0};
    result.axes[1] = {-r * l21 / (l11 * l22), r / l22, 0};
    result.axes[2] = {r * (l21 * l32 - l31 * l22) / (l11 * l22 * l33), -r * l32 / (l22 * l33), r / l33};
    return result;
}

std::vector<Vec3> spread_points(const Ellipsoid& ellipsoid, int steps) {
    std::vector<Vec3> points;
    const auto at = [&](int i) { return (2 * i + 1.0) / steps - 1; };
    for (int side = 0; side < 6; ++side) {
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; j < steps; ++j) {
                Vec3 u;
                u[side % 3] = side < 3 ? 1 : -1;
                u[(side + 1) % 3] = at(i);
                u[(side + 2) % 3] = at(j);
                u = normalized(u);
                points.push_back(ellipsoid.centre + ellipsoid.axes[0] * u.x + ellipsoid.axes[1] * u.y +
                                 ellipsoid.axes[2] * u.z);
            }
        }
    }
    return points;
}

}  // namespace pfgeom
