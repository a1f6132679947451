// Which quadric of a set tree a face of its mesh lies on.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/frame.h"
#include "pfgeom/function/set_tree.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// For each face the quadric that is nearest to its corners and its middle, to first order: the mesh's edges
/// follow the creases, so a face lies on one quadric. The first of equal ones. There must be a quadric.
std::vector<std::int32_t> nearest_quadrics(const SetTree& tree, const Frame& frame, const TriangleMesh& mesh,
                                           const Task& task);

}  // namespace pfgeom
