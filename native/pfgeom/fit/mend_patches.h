// The end of fitting a curved mesh part: what is still over the tolerance is mended where it is.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/integer_grid.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Of a maximum. Gives `mesh`, which is on the grid, whole steps of the bulges and returns it as a part.
/// Vertices move and edges are divided where its edges, or points that no sample stands for, are farther than
/// `limits.forward` from the original.
Object mended_part(const TriangleMesh& original, CollapseMesh& mesh, CollapseError& error,
                   const CollapseLimits& limits, const Grid& grid, int bulge_code, const Task& task);

}  // namespace pfgeom
