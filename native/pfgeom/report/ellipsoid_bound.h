// A quick proof for the solid that most often is a single quadric: an ellipsoid and a closed mesh around its
// centre, compared along the rays from there. bound_tree() proves the same of any tree, in a hundred times
// the time.
#pragma once

#include "pfgeom/function/quadric.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <optional>

namespace pfgeom {

/// Proved: what lies farther than this from the mesh is inside where the quadric is above 0, and outside
/// where it is below; and no point of the mesh is farther than this from the quadric's surface. In the mesh's
/// units, which should be about one; `bvh` is its hierarchy. Inside is what the mesh encloses, whichever way
/// its normals point. Nothing if the quadric is above 0 elsewhere than in an ellipsoid, or if the mesh is not
/// closed or does not go around the centre once.
std::optional<double> bound_ellipsoid(const Quadric& quadric, const TriangleMesh& mesh, const Bvh& bvh);

}  // namespace pfgeom
