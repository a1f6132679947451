// The end of fitting a mesh part: what is still over the tolerance is mended where it is.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/integer_grid.h"
#include "pfgeom/function/model.h"

#include <cstddef>

namespace pfgeom {

struct MendedPart {
    Object object;
    std::size_t wrong = 0;  ///< vertices around what is still over the limits
};

/// Returns `mesh`, which is on the grid, as a part; curved faces get whole steps of the bulges. If it is a
/// maximum that counts, vertices move and edges are divided where it is farther than the limits from the
/// original, at a closer look, or where points are that no sample stands for.
MendedPart mended_part(const TriangleMesh& original, CollapseMesh& mesh, CollapseError& error,
                       const CollapseLimits& limits, const Grid& grid, int bulge_code, const Task& task);

}  // namespace pfgeom
