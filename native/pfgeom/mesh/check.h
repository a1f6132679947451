// What must hold of the values of a mesh before anything looks at its shape.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// Throws InvalidInput with the row of the first face whose index is out of range.
void check_indices(const TriangleMesh& mesh);
/// Throws InvalidInput with the row of the first vertex that is not finite, or beyond what can be computed
/// with.
void check_finite(const TriangleMesh& mesh);

}  // namespace pfgeom
