// A mesh part's triangles in the world.
#pragma once

#include "pfgeom/function/model.h"
#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// `object.shape` must be a MeshPart. Vertex = frame.to_world(position · step).
TriangleMesh mesh_of(const Object& object);

}  // namespace pfgeom
