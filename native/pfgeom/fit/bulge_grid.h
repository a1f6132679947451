// The last step of fitting a curved mesh part: its bulges go to whole steps.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Fills part.bulges. `part` has the faces and vertices of `mesh`, on its grid, in the order of
/// CollapseMesh::faces_left(); part.bulge_code says how large a step is. Of the bulges that keep the limits
/// it takes the nearest to what fits best; returns how many edges have none.
std::size_t snap_bulges(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits,
                        const Frame& frame, MeshPart& part, const Task& task);

}  // namespace pfgeom
