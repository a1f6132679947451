// The last step of fitting a curved mesh part: its bulges go to whole steps.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/function/model.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

/// The two vertices of an edge.
using EdgeEnds = std::array<std::int32_t, 2>;

/// Fills part.bulges. `part` has the faces and vertices of `mesh`, on its grid, in the order of
/// CollapseMesh::faces_left(); part.bulge_code says how large a step is. Of the bulges that keep the limits
/// it takes the nearest to what fits best, or where they are `settled` what is there; returns the edges that
/// have none.
std::vector<EdgeEnds> snap_bulges(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits,
                                  const Frame& frame, MeshPart& part, bool settled, const Task& task);

}  // namespace pfgeom
