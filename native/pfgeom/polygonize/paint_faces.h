// Materials of a mesh's faces. Faces that two materials share are cut along the border.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/frame.h"
#include "pfgeom/function/material_map.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// `tree_of`: for each face its tree, in the frame's cube. Faces are divided so that no point farther than
/// `snap` (in the mesh's units) from its face's border has another material than the face; the surface and
/// what hangs together stay as they are. New vertices come last; faces come in other places. Returns the
/// material of each. Throws LimitExceeded if it takes more than 20 million faces.
std::vector<std::int32_t> paint_faces(TriangleMesh& mesh, const Frame& frame,
                                      std::span<const MaterialTree* const> tree_of, double snap,
                                      const Task& task);

}  // namespace pfgeom
