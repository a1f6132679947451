#include "pfgeom/render/extreme.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// How far behind the surface a point is taken to be of the other side, in the cube's units: above rounding
// and below kReach.
constexpr double kBehind = 1e-10;
// On a sheet, likewise; and back from behind a surface.
constexpr double kOnSheet = 1e-13, kStepBack = 8 * kBehind;
constexpr int kSweeps = 5;  // of Newton steps onto each condition of a region, and back into the cell
// Models around one point after another: from closer than half the radius of curvature four leave 1/16 of a
// first error, and most end after two.
constexpr int kModels = 4;
// A model around a point this close to the one before, as a share of the cell, tells nothing new.
constexpr double kStill = 1e-9;
// Cells below this size are not divided: rounding would decide.
constexpr double kSmallest = 1e-9;
// Cells that one search may look at. Points within 1 % of the diagonal from igea's surface need 7 to 267,
// those around it up to 1,700, at an accuracy of 1e-6; the axis of a bore, from which all of it is equally
// far, and hostile expressions could ask for any number. A search then takes some 0.05 s.
constexpr int kBudget = 10'000;
constexpr int kPoll = 64;  // cells between two polls: a millisecond

}  // namespace

Extreme ExtremeSearch::run(const SurfaceCells& cells, const SearchGoal& goal, double within,
                           double accuracy) {
    cells_ = &cells;
    goal_ = goal;
    within_ = within;
    accuracy_ = std::max(accuracy, kBehind);
    best_ = {};
    pool_.clear(), free_.clear(), heap_.clear();
    const bool from_inside = !cells.open() && !goal.along && is_inside(goal.place);
    side_ = cells.open() ? Side::sheet : from_inside ? Side::outside : Side::inside;
    if (from_inside) look_at_box_sides();
    const RayOctree& tree = cells.octree();
    if (tree.root >= 0) {
        push({goal.least(tree.box), tree.root, tree.box, {}});
    } else {
        open_leaf(tree.root, tree.box);
    }
    for (int looked = 0; !heap_.empty(); ++looked) {
        std::pop_heap(heap_.begin(), heap_.end(),
                      [&](auto a, auto b) { return pool_[a].bound > pool_[b].bound; });
        if (looked % kPoll == 0) task_.check();
        const Candidate next = pool_[heap_.back()];
        free_.push_back(heap_.back());
        heap_.pop_back();
        if (next.bound >= std::min(best_.cost, within_) - accuracy_ || looked == kBudget) {
            discard(next.bound);
            break;
        }
        if (RayOctree::is_leaf(next.cell)) {
            divide(next);
        } else {
            open_node(next);
        }
    }
    if (best_.found()) settle_on_surface();
    best_.proved = std::min(best_.proved, best_.cost - 2 * kBehind);
    return best_;
}

// The octree holds nothing around its box, which is outside.
bool ExtremeSearch::is_inside(const Vec3& p) const {
    const RayOctree& tree = cells_->octree();
    if (!tree.box.contains(p)) return false;
    Box box = tree.box;
    std::int32_t cell = tree.root;
    while (cell >= 0) {
        const Vec3 middle = box.centre();
        unsigned place = 0;
        for (int axis = 0; axis < 3; ++axis) place |= p[axis] > middle[axis] ? 1U << axis : 0U;
        box = child_box(box, place);
        cell = tree.nodes[static_cast<std::size_t>(cell)][place];
    }
    if (!RayOctree::is_leaf(cell)) return cell == RayOctree::kInside;
    return cells_->is_inside(RayOctree::leaf_of(cell), p);
}

// A side of the box is surface where it closes an inside. Where the nearest one does not, surface is nearer.
void ExtremeSearch::look_at_box_sides() {
    const Box& box = cells_->octree().box;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) {
            Vec3 point = goal_.place;
            point[axis] = (upper ? box.hi : box.lo)[axis];
            const double cost = goal_.cost(point);
            if (cost < best_.cost) best_.cost = cost, best_.point = point;
        }
    }
    if (!is_inside(best_.point)) best_ = {};
}

void ExtremeSearch::push(const Candidate& candidate) {
    if (candidate.bound >= std::min(best_.cost, within_) - accuracy_) {
        discard(candidate.bound);
        return;
    }
    std::int32_t row = 0;
    if (free_.empty()) {
        row = static_cast<std::int32_t>(pool_.size());
        pool_.push_back(candidate);
    } else {
        row = free_.back();
        free_.pop_back();
        pool_[row] = candidate;
    }
    heap_.push_back(row);
    std::push_heap(heap_.begin(), heap_.end(),
                   [&](auto a, auto b) { return pool_[a].bound > pool_[b].bound; });
}

void ExtremeSearch::discard(double bound) {
    best_.proved = std::min(best_.proved, bound);
}

void ExtremeSearch::open_node(const Candidate& node) {
    const auto& children = cells_->octree().nodes[static_cast<std::size_t>(node.cell)];
    for (unsigned place = 0; place < 8; ++place) {
        const Box box = child_box(node.box, place);
        if (children[place] >= 0) {
            push({goal_.least(box), children[place], box, {}});
        } else {
            open_leaf(children[place], box);
        }
    }
}

void ExtremeSearch::open_leaf(std::int32_t cell, const Box& box) {
    const double least = goal_.least(box);
    if (!RayOctree::is_leaf(cell)) {
        const Side side = cell == RayOctree::kInside ? Side::inside : Side::outside;
        if (side == side_) offer(cell, box, {}, goal_.best_of(box));
        return;
    }
    if (least >= std::min(best_.cost, within_) - accuracy_) {
        discard(least);
        return;
    }
    cells_->regions(RayOctree::leaf_of(cell), side_, regions_);
    for (const SignRegion& region : regions_) examine(cell, box, region, least);
}

void ExtremeSearch::divide(const Candidate& leaf) {
    const Vec3 size = leaf.box.extent();
    if (std::max({size.x, size.y, size.z}) < kSmallest) {
        discard(leaf.bound);
        return;
    }
    for (unsigned place = 0; place < 8; ++place)
        examine(leaf.cell, child_box(leaf.box, place), leaf.region, leaf.bound);
}

// Bounds a region in a cell from below and, by its point, the answer from above.
void ExtremeSearch::examine(std::int32_t cell, const Box& box, const SignRegion& region, double known) {
    double bound = std::max(known, goal_.least(box));
    Vec3 at = goal_.along ? box.centre() : goal_.best_of(box);
    const Vec3 size = box.extent();
    const double still = kStill * std::max({size.x, size.y, size.z});
    for (int round = 0; round < kModels; ++round) {
        if (bound >= std::min(best_.cost, within_) - accuracy_) break;
        std::array<LocalCondition, 2 * SignRegion::kMost> conditions;
        std::size_t count = 0;
        for (std::size_t i = 0; i < region.count; ++i) {
            const Condition& c = region.conditions[i];
            const Expansion e = cells_->expand(RayOctree::leaf_of(cell), c.function, at);
            if (c.sense != Sense::negative) conditions[count++] = local_condition(e, true);
            if (c.sense != Sense::positive) conditions[count++] = local_condition(e, false);
        }
        const RegionBound found = bound_region(goal_, box, at, std::span(conditions).first(count));
        if (!(found.cost < std::numeric_limits<double>::infinity())) return;
        bound = std::max(bound, found.cost);
        const double moved = norm(found.point - at);
        at = found.point;
        offer(cell, box, region, at);
        if (moved <= still) break;
    }
    push({bound, cell, box, region});
}

// Moves a point onto the region, a little behind its surface, and takes it if it is better than the best.
void ExtremeSearch::offer(std::int32_t cell, const Box& box, const SignRegion& region, Vec3 point) {
    const double limit = std::min(best_.cost, within_);
    if (!(goal_.cost(point) < limit)) return;
    const std::int32_t leaf = RayOctree::leaf_of(cell);
    bool moved = true;
    for (int sweep = 0; sweep < kSweeps && moved; ++sweep) {
        moved = false;
        for (std::size_t i = 0; i < region.count; ++i) {
            const Vec3 step = step_onto(leaf, region.conditions[i], point);
            moved = moved || !(step == Vec3{});
            point += step;
        }
        point = max(box.lo, min(point, box.hi));
    }
    const double cost = goal_.cost(point);
    if (!(cost < limit)) return;
    if (RayOctree::is_leaf(cell) && !belongs(leaf, region, point)) return;
    best_.cost = cost;
    best_.point = point;
}

// To where the condition holds, by Newton; zero where it does.
Vec3 ExtremeSearch::step_onto(std::int32_t leaf, const Condition& condition, const Vec3& point) const {
    const Expansion e = cells_->expand(leaf, condition.function, point);
    const double steep = norm(e.gradient);
    if (!(steep > 0)) return {};
    if (condition.sense == Sense::zero) {
        const double off = e.value / steep;
        return std::abs(off) > kOnSheet ? e.gradient * (-off / steep) : Vec3{};
    }
    const double sign = condition.sense == Sense::positive ? 1 : -1;
    const double missing = kBehind - sign * e.value / steep;
    return missing > 0.5 * kBehind ? e.gradient * (sign * missing / steep) : Vec3{};
}

bool ExtremeSearch::belongs(std::int32_t leaf, const SignRegion& region, const Vec3& point) const {
    if (side_ != Side::sheet) return cells_->is_inside(leaf, point) == (side_ == Side::inside);
    const Expansion e = cells_->expand(leaf, region.conditions[0].function, point);
    return std::abs(e.value) <= kBehind * norm(e.gradient) && cells_->is_inside(leaf, point);
}

// A point of the other side is an upper bound, and on the way to it there is surface: nearly always at once.
void ExtremeSearch::settle_on_surface() {
    if (goal_.along || side_ == Side::sheet) return;
    const bool inside = side_ == Side::inside;
    const Vec3 way = goal_.place - best_.point;
    if (best_.cost <= kStepBack || is_inside(best_.point + way * (kStepBack / best_.cost)) != inside) return;
    double other = 0, own = 1;
    while (own - other > 1e-15) {
        const double middle = other + 0.5 * (own - other);
        (is_inside(best_.point + way * middle) == inside ? other : own) = middle;
    }
    best_.point += way * other;
    best_.cost = goal_.cost(best_.point);
}

}  // namespace pfgeom
