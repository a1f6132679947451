// A mesh part's triangles in the world.
#pragma once

#include "pfgeom/eval/patches.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// `object.shape` must be a MeshPart. Both halves of a mirrored one; curved faces are divided.
TriangleMesh mesh_of(const Object& object, const Fineness& fineness, const Task& task = {});

/// As fine as values at points and signs need it. `diagonal`: of the model that the object comes from.
TriangleMesh mesh_for_values(const Object& object, double diagonal);

}  // namespace pfgeom
