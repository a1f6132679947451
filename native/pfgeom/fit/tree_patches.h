// Which quadric answers for which face, with as few quadrics as possible.
#pragma once

#include "pfgeom/fit/tree_quadric.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/segment/segment.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

struct Patches {
    std::vector<QuantisedQuadric> quadrics;
    std::vector<std::int32_t> of_face;
};

/// `own`: a quadric of each region. From the smallest region on, one whose faces the other quadrics serve
/// within `limit`, each face by any of them, gives up its own: rounded quadrics miss less than they may, and
/// a narrow region between two large ones often lies within the tolerance of both.
Patches assign_patches(const TriangleMesh& mesh, const std::vector<Region>& regions,
                       const std::vector<QuantisedQuadric>& own, double limit);

}  // namespace pfgeom
