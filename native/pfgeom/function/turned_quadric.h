// A quadric in its own frame, without products of coordinates.
#pragma once

#include "pfgeom/function/quadric_shape.h"

#include <array>

namespace pfgeom {

/// Σ squares[i] y_i² + linear[i] y_i + constant, with y_i = axes[i] · (p - origin).
struct TurnedQuadric {
    Vec3 origin;
    std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< orthonormal
    std::array<double, 3> squares{}, linear{};
    double constant = 0;

    Vec3 local(const Vec3& p) const { return turn(p - origin); }
    Vec3 turn(const Vec3& d) const { return {dot(axes[0], d), dot(axes[1], d), dot(axes[2], d)}; }
    double local_value(const Vec3& y) const {
        return (squares[0] * y.x + linear[0]) * y.x + (squares[1] * y.y + linear[1]) * y.y +
               (squares[2] * y.z + linear[2]) * y.z + constant;
    }
    Vec3 local_gradient(const Vec3& y) const {
        return {2 * squares[0] * y.x + linear[0], 2 * squares[1] * y.y + linear[1],
                2 * squares[2] * y.z + linear[2]};
    }
    double value(const Vec3& p) const { return local_value(local(p)); }
};

/// The quadric about an origin, along the eigenvectors of its squares.
TurnedQuadric turned(const Quadric& quadric, const Vec3& origin);

/// Kind and parameters. Squares, what is left of linear terms and the value at the centre count as zero, and
/// squares as equal, to 1e-12 of what they were computed from.
QuadricShape shape_of(const TurnedQuadric& quadric);

}  // namespace pfgeom
