// Representatives for vertices that nearly coincide.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// For each vertex its representative: itself, or for one of the `candidates` (rising rows) a lower candidate
/// at most `distance` away. The corners of a face keep different representatives, so that no face collapses.
std::vector<std::int32_t> near_representatives(const TriangleMesh& mesh,
                                               const std::vector<std::int32_t>& candidates, double distance,
                                               const Task& task);

}  // namespace pfgeom
