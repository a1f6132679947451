// Cells in which the mesh is nearly flat, closed at once.
#pragma once

#include "pfgeom/report/tree_bound_cells.h"

namespace pfgeom {

// Near the cell the mesh lies between two parallel planes, and what of the cell is beyond both and further
// than the tolerance from it is rightly labelled. The cell must be measured.
bool holds_around_slab(const TreeBoundProblem& problem, const TreeBoundCell& cell,
                       std::vector<std::int32_t>& faces, PrunedTree& part);

}  // namespace pfgeom
