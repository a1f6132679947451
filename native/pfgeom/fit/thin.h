// Fewer triangles for a mesh of functions: chords follow every bend alike, edge collapses use what each place
// leaves.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// The mesh with fewer triangles, collapsed to lie within `distance` of it both ways, borders too. Closed
/// manifolds stay closed manifolds, of their genus. Deterministic.
TriangleMesh thinned(const TriangleMesh& mesh, double distance, const Task& task = {});

}  // namespace pfgeom
