// Folds: edges where a mesh turns back on itself.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/polygonize/labelled_mesh.h"

namespace pfgeom {

/// Collapses edges up to `longest` beside folds, one of its ends into the other, if the mesh bends less
/// without them. `mesh` stays a closed 2-manifold of its genus.
void unfold(double longest, LabelledMesh& mesh, const Task& task);

}  // namespace pfgeom
