// The simplest quadric that a part of a surface lies on: a plane, or else the one of least squares.
#pragma once

#include "pfgeom/function/quadric.h"

#include <optional>
#include <vector>

namespace pfgeom {

/// Points, and what the quadric falls along there.
struct QuadricSamples {
    std::vector<Vec3> points, directions;
    std::vector<double> weights;
    Vec3 loops;  ///< twice the vector area of what they are of: the normal of planar ones

    void add(const Vec3& point, const Vec3& direction, double weight) {
        points.push_back(point);
        directions.push_back(direction);
        weights.push_back(weight);
    }
};

/// Its coefficients are multiples of `step`. Nothing if a point is farther than `tolerance` from it.
std::optional<Quadric> simplest_quadric(const QuadricSamples& samples, double tolerance, double step);

}  // namespace pfgeom
