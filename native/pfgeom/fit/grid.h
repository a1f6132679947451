// The last step of fitting a mesh part: its vertices go to points of the grid that it is stored on.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/integer_grid.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// Moves each vertex (the bulges at it follow) onto the grid, within the limits if that can be: along the
/// surface to a lattice that is coarser than the grid where it may (up to 2^`coarsest` steps), across it to
/// single steps. Coarse lattices cost fewer bits. False: too many are over the limits for the grid to be fine
/// enough; then, unless `persistent`, they are not mended.
bool snap_vertices(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Grid& grid,
                   bool persistent, const Task& task);

/// The corners of the faces that are over the limits, of a maximum, in rising order.
std::vector<std::int32_t> vertices_over(const CollapseMesh& mesh, const CollapseError& error,
                                        const CollapseLimits& limits, const Task& task);

/// The last part of that, of vertices that are on the grid: which of `open` are over the limits, and their
/// neighbours, move from grid point to grid point while that makes the worst better. Returns those that are
/// over the limits still.
std::vector<std::int32_t> mend_vertices(CollapseMesh& mesh, CollapseError& error,
                                        const CollapseLimits& limits, const Grid& grid,
                                        std::vector<std::int32_t> open, const Task& task);

}  // namespace pfgeom
