// Angles with the same bits on every machine: libm's differ, and what is inside a surface decides what is
// coded.
#pragma once

#include "pfgeom/base/vec.h"

namespace pfgeom {

/// Angle of (x, y) in [-pi, pi], like std::atan2 but for signed zeros; at most 2 ulp off; 0 for (0, 0).
double reproducible_atan2(double y, double x);

/// Angle between two vectors in [0, pi]; 0 if one of them is zero.
double angle_between(const Vec3& a, const Vec3& b);

}  // namespace pfgeom
