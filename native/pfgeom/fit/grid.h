// The last step of fitting a mesh part: its vertices go to points of the grid that it is stored on.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

struct Grid {
    Frame frame;
    int step_code = 0;

    double step() const { return frame.half() * exp2_eighths(step_code); }
    std::array<std::int32_t, 3> nearest(const Vec3& p) const;
    Vec3 point(const std::array<std::int32_t, 3>& q) const;
    /// The coarsest grid with a step of at most `step` (and not so fine that the codec could not take it).
    static Grid around(const Box& box, double step);
};

/// Moves each vertex onto the grid, within the limits if that can be: along the surface to a lattice that is
/// coarser than the grid where it may (up to 32 steps), across it to single steps. Coarse lattices cost fewer
/// bits.
bool snap_vertices(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Grid& grid,
                   bool persistent, const Task& task);

}  // namespace pfgeom
