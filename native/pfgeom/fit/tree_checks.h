// Where each region's quadric is checked, and how far it may pass: nearer at creases.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/whole_checks.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/segment/segment.h"

#include <span>
#include <vector>

namespace pfgeom {

/// Vertices, edge middles and centroids of each region. The limit is `share` of the tolerance, but where
/// faces of several regions meet it is less, by the distance of the origin to the hull of their normals: two
/// surfaces at an angle φ that pass their faces at a distance e intersect at e / cos(φ/2) from the crease,
/// three at right angles at e √3 from the corner, and a pit between three ellipsoids fills at its narrow end.
/// A limit that the region's own quadric breaks is widened to what it keeps. `held`: points around which
/// whole quadrics must move less, by their share.
std::vector<RegionChecks> region_checks(const TriangleMesh& mesh, const std::vector<Region>& regions,
                                        std::span<const Spot> held, double tolerance, double share,
                                        const Task& task);

}  // namespace pfgeom
