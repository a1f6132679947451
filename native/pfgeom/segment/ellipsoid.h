// Quadrics that bound a volume.
#pragma once

#include "pfgeom/function/quadric.h"

#include <array>
#include <optional>
#include <vector>

namespace pfgeom {

/// { centre + Σ u_k axes[k] : |u| = 1 }. The axes are conjugate, not orthogonal.
struct Ellipsoid {
    Vec3 centre;
    std::array<Vec3, 3> axes;
};

/// The zero set of q if that is an ellipsoid, whichever side of it is positive.
std::optional<Ellipsoid> ellipsoid_of(const Quadric& q);

/// 6 steps² points spread over the ellipsoid.
std::vector<Vec3> spread_points(const Ellipsoid& ellipsoid, int steps);

}  // namespace pfgeom
