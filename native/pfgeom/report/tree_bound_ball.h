// A change of a tree's label within a ball.
#pragma once

#include "pfgeom/eval/pruned_tree.h"

namespace pfgeom {

struct Ball {
    Vec3 centre;
    double radius = 0;
};

/// Does the tree have both labels within the ball? Asks a few points first, those along the normal before
/// others, then the points of its quadrics, their intersections and corners that are closest to the centre.
/// `true` is certain, `false` is not. The tree must be right within the ball.
bool label_changes_within(const TreePruner& pruner, const PrunedTree& tree, const Ball& ball,
                          const Vec3& normal);
bool label_changes_near_quadrics(const TreePruner& pruner, const PrunedTree& tree, const Ball& ball);

/// Directions spread over the sphere: those of the cube's faces, corners and edges.
std::span<const Vec3> spread_directions();

}  // namespace pfgeom
