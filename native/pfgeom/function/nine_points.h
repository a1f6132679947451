// The quadric through nine points: the exact case of the method's first step. What is fitted to more points,
// by least squares and with normals, is in fit/.
#pragma once

#include "pfgeom/function/quadric.h"

#include <span>

namespace pfgeom {

/// The one quadric through the points, in their own coordinates. Its ten coefficients have norm 1 and
/// A + B + C <= 0, so that an ellipsoid is positive inside. Throws InvalidInput unless the points are nine,
/// are finite, span between 2^-120 and 2^120, and leave but one: four on a line, seven in a plane, or all
/// eight corners of a box leave more.
Quadric nine_points(std::span<const Vec3> points);

}  // namespace pfgeom
