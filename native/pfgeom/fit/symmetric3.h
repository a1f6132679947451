// A symmetric 3 by 3 system, for small least squares.
#pragma once

#include "pfgeom/base/vec.h"

#include <algorithm>

namespace pfgeom {

struct Symmetric3 {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    /// + weight · a aᵀ
    void add(const Vec3& a, double weight) {
        xx += weight * a.x * a.x, xy += weight * a.x * a.y, xz += weight * a.x * a.z;
        yy += weight * a.y * a.y, yz += weight * a.y * a.z, zz += weight * a.z * a.z;
    }
    void add_diagonal(double d) { xx += d, yy += d, zz += d; }
    double trace() const { return xx + yy + zz; }
    Vec3 operator*(const Vec3& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
    Symmetric3& operator+=(const Symmetric3& o) {
        xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
        return *this;
    }

    /// x of A x = b by L D Lᵀ for a positive definite A; pivots at rounding level give zero components.
    Vec3 solve(const Vec3& b) const {
        const double least = 1e-14 * trace();
        const auto over = [&](double value, double pivot) { return pivot > least ? value / pivot : 0.0; };
        const double l10 = over(xy, xx), l20 = over(xz, xx);
        const double d1 = yy - l10 * xy;
        const double l21 = over(yz - l20 * xy, d1);
        const double d2 = zz - l20 * xz - l21 * (yz - l20 * xy);
        const double y0 = b.x, y1 = b.y - l10 * y0, y2 = b.z - l20 * y0 - l21 * y1;
        const double z = over(y2, d2), y = over(y1, d1) - l21 * z;
        return {over(y0, xx) - l10 * y - l20 * z, y, z};
    }
};

}  // namespace pfgeom
