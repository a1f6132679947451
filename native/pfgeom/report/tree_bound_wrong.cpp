// The part of the cell search that looks for counter-examples where a cell could not be closed.
#include "pfgeom/function/moved_box.h"
#include "pfgeom/report/tree_bound_cells.h"
#include "pfgeom/report/tree_bound_hunt.h"

#include <cmath>

namespace pfgeom {
namespace {

// In tolerances. Without the probe, a quadric of fandisk shifted by 1.3 tolerances took 36 million cells: the
// part of the tube's border that it crosses was split to the finest.
constexpr double kProbeBelow = 4, kJustOutside = 1.01;

}  // namespace

// Records p if it is a counter-example.
bool CellSearch::refute(const Vec3& p, std::int32_t hint) {
    const SignedClosest closest = problem_.sides.at(p, hint);
    ++found_.counts.queries;
    if (std::abs(closest.distance) <= problem_.tolerance) return false;
    const PrunedNode& leaf = problem_.pruner.leaf_at(problem_.pruner.whole(), p);
    const bool inside = closest.distance > 0;
    if (leaf.inside == inside) return false;
    found_.add_counter_example({p, std::abs(closest.distance), closest.face, inside}, leaf.leaf);
    return true;
}

// A wrong point closes the cell; so does its size.
bool CellSearch::give_up_closed(const TreeBoundCell& cell, bool inside) {
    points_.clear();
    hunt_label(problem_.pruner, cell.tree, cell.box, !inside, points_);
    bool refuted = false;
    for (const Vec3& p : points_) refuted = refute(p, cell.closest.face) || refuted;
    if (refuted) return true;
    if (cell.side() >= problem_.options.give_up * problem_.tolerance) return false;
    ++found_.counts.unresolved;
    for (const PrunedNode& node : cell.tree)
        if (node.question < 0 && node.inside != inside && node.leaf >= 0) found_.suspects.insert(node.leaf);
    return true;
}

// A wrong point closes a cell at the border of the tube, too. Just outside the tube on both sides of the
// closest point, and at the corners: asked only where the tree contradicts the closest point's normal.
bool CellSearch::probed_wrong(const TreeBoundCell& cell) {
    const double tolerance = problem_.tolerance;
    if (!cell.measured || cell.side() >= kProbeBelow * tolerance) return false;
    const Vec3 q = cell.closest.point, n = problem_.sides.normal_at(cell.closest);
    const auto wrong = [&](const Vec3& p) {
        const double level = dot(n, p - q);
        return std::abs(level) > tolerance &&
               problem_.pruner.contains(problem_.pruner.whole(), p) != (level < 0) &&
               refute(p, cell.closest.face);
    };
    if (wrong(q + n * (kJustOutside * tolerance)) || wrong(q - n * (kJustOutside * tolerance))) return true;
    const Box& box = cell.box;
    for (unsigned corner = 0; corner < 8; ++corner)
        if (wrong(corner_of(box, corner))) return true;
    return false;
}

}  // namespace pfgeom
