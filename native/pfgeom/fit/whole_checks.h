// Where the quadric of a whole ellipsoid is checked: at its visible faces, which share creases and pits with
// others, and at its hidden part.
#pragma once

#include "pfgeom/fit/tree_quadric.h"
#include "pfgeom/segment/segment.h"

#include <span>
#include <vector>

namespace pfgeom {

struct RegionChecks {
    std::vector<CheckPoint> points;
    PowerSums sums;  ///< what least squares weigh
};

/// A point of the surface, and the share of the limit that counts there.
struct Spot {
    Vec3 point;
    double share = 1;
};

/// The limit at visible spots is `share` of the tolerance, times the spot's. Least squares hold the surface
/// there the more the less it may move; a limit that they break is widened to what they keep.
RegionChecks checks_of_whole(const Region& region, std::span<const Spot> spots, double tolerance,
                             double share);

}  // namespace pfgeom
