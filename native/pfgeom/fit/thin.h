// Fewer triangles for a mesh of functions: cells and chords follow every bend alike, edge collapses use what
// each place leaves.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// The mesh without the vertices that it can spare within `distance` both ways, borders too. The others stay
/// where they are, so flat faces stay flat and creases on their curves. Closed manifolds stay closed
/// manifolds of their genus. Deterministic.
TriangleMesh thinned(const TriangleMesh& mesh, double distance, const Task& task = {});

}  // namespace pfgeom
