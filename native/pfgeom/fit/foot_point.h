// The point of a curved triangle that is closest to a given one, nearly.
#pragma once

#include "pfgeom/function/curved_triangle.h"

namespace pfgeom {

struct FootPoint {
    Vec3 weights;  ///< of the corners
    Vec3 point;
    double squared = 0;  ///< distance
};

/// Of a flat triangle, exactly.
Vec3 closest_weights(const Vec3& p, const std::array<Vec3, 3>& corners);

/// A few steps of Gauss and Newton within the triangle, from the foot point on the flat one. What it finds is
/// on the surface, so the distance is never too small.
FootPoint foot_point(const Vec3& p, const CurvedTriangle& triangle);
/// From weights that are at hand; it ends where a squared distance is `good_enough`.
FootPoint foot_point(const Vec3& p, const CurvedTriangle& triangle, const Vec3& start, double good_enough);

}  // namespace pfgeom
