// Branch and bound as for distances between surfaces (report/distance_search.h), over octree cells: the
// signed distance is 1-Lipschitz, so the centre's says what a whole cell is; the tree is pruned on the way
// down.
//
// Three kinds of cells. Pure: the tree has one label; the cell holds if no point of it is further than the
// tolerance on the other side. Mixed and far (wholly further than the tolerance from the mesh): it must
// become pure; when it is small, it is hunted for a wrong point. Mixed at the tube: it holds within the tube,
// by the slab test, or at last with what it sticks out of the tube as excess.
#include "pfgeom/report/tree_bound_cells.h"

#include "pfgeom/report/tree_bound_slab.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// In tolerances. Only below this are mixed cells measured, pruned in pairs and tested for slabs; between 20
// and 150, the number of cells changes by less than 1 %.
constexpr double kLocalBelow = 60;
// Cells with a wrong centre are not split below this.
constexpr double kWrongBelow = 2;
// Of cells at the border of the tube, once there are counter-examples.
constexpr double kFinestOfWrong = 1.0 / 2;
// A part of the work ends with so many: the next pass, after a repair, sees the rest.
constexpr std::int64_t kEnoughWrong = 1000;
// Mixed cells are hunted from this on.
constexpr double kHuntBelow = 1.0 / 8;
// What two computed distances may differ by from what their points allow. Sides that contradict each other
// differ by more, if it matters.
constexpr double kJump = 1e-9;

}  // namespace

Vec3 TreeBoundCell::half() const {
    const Vec3 c = centre();
    return max(box.hi - c, c - box.lo);
}

double TreeBoundCell::radius() const {
    return norm(half()) * (1 + 1e-14);
}

double TreeBoundCell::side() const {
    const Vec3 e = box.extent();
    return std::max({e.x, e.y, e.z});
}

bool TreeBoundCell::has_child(int corner) const {
    for (int axis = 0; axis < 3; ++axis)
        if ((corner >> axis & 1) && !splits(axis)) return false;
    return true;
}

CellSearch::CellSearch(const TreeBoundProblem& problem, std::size_t labels_kept, std::uint64_t seed,
                       bool refuted)
    : problem_(problem), found_(problem.options, labels_kept, seed), refuted_(refuted) {}

TreeBoundCell CellSearch::root() const {
    TreeBoundCell cell;
    cell.box = problem_.sides.bvh().bounds();
    cell.box.grow(problem_.box);
    cell.tree = problem_.pruner.whole();
    cell.distance = {-Box::kInf, Box::kInf};
    return cell;
}

void CellSearch::measure(TreeBoundCell& cell) {
    if (cell.measured) return;
    ++found_.counts.queries;
    const Vec3 centre = cell.centre();
    const SignedClosest closest = problem_.sides.at(centre, cell.closest.face);
    if (closest.distance < cell.distance.lo - kJump || closest.distance > cell.distance.hi + kJump)
        found_.sides_defined = false;
    cell.distance = {closest.distance, closest.distance};
    cell.closest = closest;
    cell.measured = true;
    if (std::abs(closest.distance) <= problem_.tolerance) return;
    const bool inside = closest.distance > 0;
    if (problem_.pruner.contains(cell.tree, centre) == inside)
        found_.labels.add({centre, std::abs(closest.distance), cell.closest.face, inside});
}

void CellSearch::need(const TreeBoundCell& cell) {
    if (cell.tree[0].leaf >= 0) found_.needed.insert(cell.tree[0].leaf);
}

bool CellSearch::pure_closed(TreeBoundCell& cell) {
    const bool inside = cell.tree[0].inside;
    const double radius = cell.radius(), tolerance = problem_.tolerance;
    const auto least = [&] { return inside ? cell.distance.lo : -cell.distance.hi; };
    if (least() < radius - tolerance) measure(cell);
    if (least() >= radius - tolerance) {
        if (least() > tolerance) need(cell);
        return true;
    }
    const double distance = least();  // of the centre now
    if (distance < -tolerance) {
        refute(cell.centre(), cell.closest.face);
        if (distance < -tolerance - radius || cell.side() < kWrongBelow * tolerance) return true;
    }
    if (slab_closed(cell) || probed_wrong(cell)) return true;
    if (cell.side() >= finest() * tolerance) return false;
    found_.excess = std::max(found_.excess, radius - distance - tolerance);
    return true;
}

bool CellSearch::mixed_closed(TreeBoundCell& cell) {
    const double radius = cell.radius(), tolerance = problem_.tolerance;
    const auto nearest = [&] { return std::max({cell.distance.lo, -cell.distance.hi, 0.0}); };
    const auto furthest = [&] { return std::max(std::abs(cell.distance.lo), std::abs(cell.distance.hi)); };
    if (furthest() + radius <= tolerance) return true;
    if (nearest() > tolerance + radius) return far_closed(cell);
    if (radius < kLocalBelow * tolerance) {
        measure(cell);
        if (furthest() + radius <= tolerance) return true;
        if (nearest() > tolerance + radius) return far_closed(cell);
    }
    if (slab_closed(cell) || probed_wrong(cell)) return true;
    if (cell.side() >= finest() * tolerance) return false;
    measure(cell);
    found_.excess = std::max(found_.excess, nearest() + radius - tolerance);
    return true;
}

bool CellSearch::far_closed(TreeBoundCell& cell) {
    const bool inside = cell.distance.lo > 0;
    const double side = cell.side(), tolerance = problem_.tolerance;
    if (side < kWrongBelow * tolerance && problem_.pruner.contains(cell.tree, cell.centre()) != inside &&
        refute(cell.centre(), cell.closest.face)) {
        return true;
    }
    if (side >= kHuntBelow * tolerance) return false;
    return give_up_closed(cell, inside);
}

// What is left to find once the certificate is lost are more counter-examples.
double CellSearch::finest() const {
    const bool refuted = refuted_ || found_.counts.wrong > 0;
    return refuted ? std::max(problem_.options.finest, kFinestOfWrong) : problem_.options.finest;
}

bool CellSearch::slab_closed(const TreeBoundCell& cell) {
    if (!cell.measured || cell.radius() > kLocalBelow * problem_.tolerance) return false;
    if (std::abs(cell.distance.lo) > cell.radius() + problem_.tolerance) return false;
    ++found_.counts.slabs;
    return holds_around_slab(problem_, cell, faces_, part_);
}

bool CellSearch::closed(TreeBoundCell& cell) {
    ++found_.counts.cells;
    problem_.task.check();
    return cell.tree[0].question < 0 ? pure_closed(cell) : mixed_closed(cell);
}

// Only long axes are halved. `corner`: bit a is the half of axis a.
void CellSearch::make_child(const TreeBoundCell& parent, int corner, TreeBoundCell& child) const {
    const Vec3 centre = parent.centre();
    child.box = parent.box;
    for (int axis = 0; axis < 3; ++axis) {
        if (!parent.splits(axis)) continue;
        (corner >> axis & 1 ? child.box.lo : child.box.hi)[axis] = centre[axis];
    }
    const double step = norm(child.centre() - centre) + kJump / 8;
    child.distance = {parent.distance.lo - step, parent.distance.hi + step};
    child.closest = parent.closest;
    child.measured = false;
    const bool paired = child.radius() < kLocalBelow * problem_.tolerance;
    problem_.pruner.prune(parent.tree, child.box, paired, {}, child.tree);
}

void CellSearch::descend(TreeBoundCell& cell, std::size_t level) {
    if (closed(cell)) return;
    if (--cells_left_ < 0 || found_.counts.wrong > kEnoughWrong ||
        found_.counts.unresolved > problem_.options.max_unresolved) {
        found_.complete = false;
        return;
    }
    if (level == levels_.size()) levels_.emplace_back();
    for (int corner = 0; corner < 8 && found_.sides_defined; ++corner) {
        if (!cell.has_child(corner)) continue;
        make_child(cell, corner, levels_[level]);
        descend(levels_[level], level + 1);
    }
}

void CellSearch::run(const TreeBoundCell& cell, std::int64_t max_cells) {
    cells_left_ = max_cells;
    TreeBoundCell root = cell;
    descend(root, 0);
}

void CellSearch::split(TreeBoundCell& cell, std::vector<TreeBoundCell>& children) {
    if (closed(cell)) return;
    for (int corner = 0; corner < 8; ++corner) {
        if (!cell.has_child(corner)) continue;
        children.emplace_back();
        make_child(cell, corner, children.back());
    }
}

}  // namespace pfgeom
