// A quadratic Bézier triangle: three corners, and how far the middle of each edge lies from the middle of its
// chord (the edge's bulge). Neighbours that agree in corners and bulges meet without a crack.
#pragma once

#include "pfgeom/base/vec.h"

#include <array>

namespace pfgeom {

struct CurvedTriangle {
    std::array<Vec3, 3> corners;
    std::array<Vec3, 3> bulges;  ///< of the edges 0-1, 1-2, 2-0

    /// The point with the weights w of the corners, which sum to one.
    Vec3 at(const Vec3& w) const {
        return (corners[0] * w.x + corners[1] * w.y + corners[2] * w.z) + bend(w);
    }
    /// Of that point: how far it is from the flat triangle's. Of the difference of two points' weights: minus
    /// the second difference, so that half way between them the surface is at
    /// (at(a) + at(b)) / 2 - bend(a - b) / 4.
    Vec3 bend(const Vec3& w) const {
        return (bulges[0] * (w.x * w.y) + bulges[1] * (w.y * w.z) + bulges[2] * (w.z * w.x)) * 4.0;
    }
    bool flat() const { return bulges[0] == Vec3{} && bulges[1] == Vec3{} && bulges[2] == Vec3{}; }

    /// The flat triangle that touches the surface at w, where it has the same weights.
    std::array<Vec3, 3> tangent(const Vec3& w) const {
        const Vec3 base = bend(w) * -1.0;
        return {base + corners[0] + (bulges[0] * w.y + bulges[2] * w.z) * 4.0,
                base + corners[1] + (bulges[0] * w.x + bulges[1] * w.z) * 4.0,
                base + corners[2] + (bulges[1] * w.y + bulges[2] * w.x) * 4.0};
    }
};

}  // namespace pfgeom
