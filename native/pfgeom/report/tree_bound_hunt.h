// Points of a box at which a pruned tree gives the wrong label.
#pragma once

#include "pfgeom/eval/pruned_tree.h"

#include <vector>

namespace pfgeom {

/// Adds the box's corners and centre where they have the label `wrong`; if none has, points found by walking
/// to where the tree has leaves of that label. What is wrong elsewhere may be missed.
void hunt_label(const TreePruner& pruner, const PrunedTree& tree, const Box& box, bool wrong,
                std::vector<Vec3>& points);

}  // namespace pfgeom
