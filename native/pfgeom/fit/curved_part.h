// The fitter of the curved mesh part: the fewest quadratic Bézier triangles within a tolerance.
#pragma once

#include "pfgeom/fit/simplify.h"

namespace pfgeom {

/// What fit_mesh_part does with options.curved; options.share > 0.
Object fit_curved_part(const TriangleMesh& mesh, const MeshPartOptions& options, const Task& task);

}  // namespace pfgeom
