// The other half of a mirrored mesh part.
#pragma once

#include "pfgeom/function/model.h"
#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// Where the plane meets its axis, in the world.
double world_place(const Frame& frame, const MirrorPlane& plane);

/// Adds the image of each vertex and face, its corners turned round. A vertex exactly on the plane is its own
/// image, so the halves are joined there.
void add_mirror_image(const Frame& frame, const MirrorPlane& plane, TriangleMesh& mesh);

}  // namespace pfgeom
