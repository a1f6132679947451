// What a quadric is to an engineer: a plane, a cylinder of such a radius around such an axis, a cone, an
// ellipsoid … For reports; nothing that is coded depends on it.
#pragma once

#include "pfgeom/function/quadric.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace pfgeom {

/// Beside each: `centre` · `axes` · `sizes` of QuadricShape, as far as they mean something.
enum class QuadricKind : std::uint8_t {
    plane,            ///< a point of it · [0] its normal, towards the negative side
    parallel_planes,  ///< between them · [0] their normal · [0] half their distance
    crossing_planes,  ///< on their line · [0] the line, [1] between them · [0] tangent of half their angle
    sphere,           ///< centre · any · [0] radius
    spheroid,         ///< centre · [0] axis of revolution · semi-axes, [1] = [2]
    ellipsoid,        ///< centre · [0 … 2] · semi-axes, falling
    circular_cylinder,    ///< on the axis · [0] axis · [0] radius
    elliptic_cylinder,    ///< on the axis · [0] axis · [0] ≥ [1] semi-axes along axes [1], [2]
    parabolic_cylinder,   ///< on the vertex line · [0] rulings, [1] where it opens to · [0] focal length
    hyperbolic_cylinder,  ///< on the axis · [0] rulings · semi-axes: [0] real, along [1], [1] imaginary
    circular_cone,        ///< apex · [0] axis · [0] tangent of half the opening angle
    elliptic_cone,        ///< apex · [0] axis · [0] ≥ [1] such tangents towards axes [1], [2]
    circular_paraboloid,  ///< vertex · [0] where it opens to · [0] focal length
    elliptic_paraboloid,  ///< vertex · [0] where it opens to · [0] ≥ [1] focal lengths along axes [1], [2]
    hyperbolic_paraboloid,  ///< saddle · [0] where it opens to along [1] · [0] ≥ [1] focal lengths along [1],
                            ///< [2]
    circular_one_sheet,   ///< hyperboloid: centre · [0] axis · semi-axes, [0] imaginary, [1] = [2]
    one_sheet,            ///< likewise, [1] ≥ [2]
    circular_two_sheets,  ///< hyperboloid: centre · [0] axis · semi-axes, [0] real, [1] = [2] imaginary
    two_sheets,           ///< likewise, [1] ≥ [2]
    line,                 ///< on it · [0] its direction
    point,                ///< it
    nothing               ///< no real point, or all of space
};
constexpr std::size_t kQuadricKinds = 22;

/// In words, such as "circular cylinder".
std::string_view name_of(QuadricKind kind);

struct QuadricShape {
    QuadricKind kind = QuadricKind::nothing;
    Vec3 centre;  ///< where there is a choice: the closest to the origin, or to the middle of the extent
    std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< orthonormal
    std::array<double, 3> sizes{};
};

/// By the coefficients alone, as they are; what is zero or equal to 1e-12 counts as that.
QuadricShape shape_of(const Quadric& quadric);

/// The simplest shape that stays within the tolerance of the quadric (distance to first order) at points of
/// the quadric, which stand for the part of it that is used: a cylinder that was rounded to ten integers is a
/// cylinder, and a short piece of a huge sphere a plane. Without points: by the coefficients alone.
QuadricShape shape_of(const Quadric& quadric, std::span<const Vec3> points, double tolerance);

}  // namespace pfgeom
