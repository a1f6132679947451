// The similarity that brings points nearest to others.
#pragma once

#include "pfgeom/function/placement.h"

#include <span>

namespace pfgeom {

/// Least squares over pairs from[i] -> to[i], of which there are as many of each, at least one. `mirrored`:
/// the best one that turns a left hand into a right one. `rigid`: of scale 1.
Similarity align_points(std::span<const Vec3> from, std::span<const Vec3> to, bool mirrored, bool rigid);

}  // namespace pfgeom
