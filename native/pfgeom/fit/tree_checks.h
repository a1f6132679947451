// Where each region's quadric is checked, and how far it may pass: nearer at creases.
#pragma once

#include "pfgeom/fit/tree_quadric.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/segment/segment.h"

#include <vector>

namespace pfgeom {

/// Vertices, edge middles and centroids of each region. The limit is `limit`, but where faces of other
/// regions meet the region's at an angle φ it is cos(φ/2) of that: two surfaces that pass their faces at a
/// distance e intersect at e / cos(φ/2) from the crease. A limit that the region's own quadric breaks is
/// widened to what it keeps.
std::vector<std::vector<CheckPoint>> region_checks(const TriangleMesh& mesh,
                                                   const std::vector<Region>& regions, double limit);

}  // namespace pfgeom
