// Forms of quadrics: what a shape with few parameters may contain in its own frame, and the closest quadric
// of a form to a piece of another one.
#pragma once

#include "pfgeom/function/turned_quadric.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pfgeom {

struct QuadricForm {
    std::array<int, 3> group;  ///< of axis i: its square has the coefficient with this number; -1: none
    std::array<bool, 3> linear;
    bool singular;       ///< the value at the centre is zero: a cone, or two crossing planes
    std::size_t orders;  ///< of a frame's axes that make a difference
    /// It is a special case of these kinds of surface, or their limit: bit k of QuadricKind k.
    std::uint32_t simplifies;
};

/// The simplest first.
std::span<const QuadricForm> quadric_forms();

/// A point of a surface, with the unit normal towards the surface's positive side.
struct SurfaceSpot {
    Vec3 point, inwards;
};

/// Fits the form to the spots, which lie within a distance of 1 of the origin, by least squares of distances
/// to first order from several beginnings; true, and the quadric, if all of them end up within the tolerance.
/// `frames`: those to begin with.
bool fit_form(const QuadricForm& form, std::span<const SurfaceSpot> spots, double tolerance,
              std::span<const std::array<Vec3, 3>> frames, TurnedQuadric& result);

/// Is the distance of all spots to the quadric, to first order, at most the tolerance, and does it run along
/// the surface there rather than across it?
bool follows(const TurnedQuadric& quadric, std::span<const SurfaceSpot> spots, double tolerance);

}  // namespace pfgeom
