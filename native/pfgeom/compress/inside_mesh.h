// The surface between what is inside of a model and what is outside.
#pragma once

#include "pfgeom/compress/compress.h"

namespace pfgeom {

/// Closed, without what lies inside of another object. Without options, as fine as the finest of the objects'
/// default meshes. Throws InvalidInput if an object is a sheet.
TriangleMesh mesh_of_inside(const Model& model, const MeshOptions& options, const Task& task);

}  // namespace pfgeom
