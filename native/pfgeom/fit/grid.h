// The last step of fitting a mesh part: its vertices go to points of the grid that it is stored on.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/integer_grid.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Moves each vertex (the bulges at it follow) onto the grid, within the limits if that can be: along the
/// surface to a lattice that is coarser than the grid where it may (up to 2^`coarsest` steps), across it to
/// single steps. Coarse lattices cost fewer bits.
bool snap_vertices(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Grid& grid,
                   bool persistent, const Task& task);

}  // namespace pfgeom
