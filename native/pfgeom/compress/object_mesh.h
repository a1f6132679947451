// The triangles of one object.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/compress/compress.h"

namespace pfgeom {

/// Of the object where its frame has it, without its copies; as fine as the finest of its copies needs.
/// Throws LimitExceeded.
TriangleMesh mesh_in_place(const Model& model, const Object& object, const MeshOptions& options,
                           const Task& task);

void turn_faces(TriangleMesh& mesh);

}  // namespace pfgeom
