#include "pfgeom/eval/tree_field.h"

#include "pfgeom/eval/cell_quadric.h"
#include "pfgeom/eval/function_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

constexpr double kEverywhere = 1e30;  // the value of `inside`; its negative that of `outside`
// Slopes below this count as this: near the axis of a cylinder or the apex of a cone S / |∇S| is no distance.
// (The scale of a quadric is chosen so that its slope is about 1 on the surface that it serves.)
constexpr double kLeastSlope = 0.25;
// A point on a question's zero set belongs to the high side, and must not get the value 0 from the low one.
constexpr double kLeastDistance = 1e-300;

// A question at a point: which side, and about how far from its zero set.
struct Answer {
    bool high = false;
    double distance = 0;  // > 0
    Vec3 gradient;        // towards the high side
};

Answer ask(const SetTree& tree, const TreeNode& node, const Vec3& p) {
    if (node.kind == TreeNode::Kind::cut) {
        Vec3 axis;
        axis[node.axis] = 1;
        const double s = p[node.axis] - node.cut;
        return {s >= 0, std::max(std::abs(s), kLeastDistance), axis};
    }
    const Quadric& q = tree.quadrics[static_cast<std::size_t>(node.quadric)].quadric;
    const Vec3 gradient = q.gradient(p);
    const double s = q.value(p), slope = std::max(norm(gradient), kLeastSlope);
    return {s >= 0, std::max(std::abs(s) / slope, kLeastDistance), gradient / slope};
}

// F at a point. With the answer at distance m, the subtree taken T and the other one O, the three-term form
// is
//     T >= 0:  min(T, max(m, O))        T < 0:  max(T, min(-m, O)),
// so O matters only where |T| > m, and only between m and T: a search with a window, as in game trees.
// Outside of (least, most) only the side is right. Recursion as deep as the tree, at most kMaxTreeDepth.
Jet evaluate(const SetTree& tree, std::int32_t index, const Vec3& p, double least, double most) {
    const TreeNode& node = tree.nodes[static_cast<std::size_t>(index)];
    if (node.leaf()) return {node.kind == TreeNode::Kind::inside ? kEverywhere : -kEverywhere, {}};
    const Answer answer = ask(tree, node, p);
    const Jet taken = evaluate(tree, answer.high ? node.high : node.low, p, least, most);
    if (std::abs(taken.value) <= answer.distance) return taken;

    const bool inside = taken.value >= 0;
    const Jet border{inside ? answer.distance : -answer.distance,
                     answer.high == inside ? answer.gradient : -answer.gradient};
    if (inside ? border.value >= most : border.value <= least) return border;
    const std::int32_t other = answer.high ? node.low : node.high;
    const double lo = std::min(border.value, taken.value), hi = std::max(border.value, taken.value);
    const Jet beyond = evaluate(tree, other, p, lo, hi);
    if (beyond.value <= lo) return inside ? border : taken;
    if (beyond.value >= hi) return inside ? taken : border;
    return beyond;
}

// Signed distance (in the maximum norm outside) to the sides of the box.
Jet within(const Box& box, const Vec3& p) {
    Jet least{std::numeric_limits<double>::infinity(), {}};
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 inwards;
        inwards[axis] = 1;
        const double low = p[axis] - box.lo[axis], high = box.hi[axis] - p[axis];
        if (low < least.value) least = {low, inwards};
        if (high < least.value) least = {high, -inwards};
    }
    return least;
}

Interval within(const Box& box, const Box& cell) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    Interval least{kInf, kInf};
    for (int axis = 0; axis < 3; ++axis) {
        least.lo = std::min({least.lo, cell.lo[axis] - box.lo[axis], box.hi[axis] - cell.hi[axis]});
        least.hi = std::min({least.hi, cell.hi[axis] - box.lo[axis], box.hi[axis] - cell.lo[axis]});
    }
    return least;
}

Jet evaluate(const SetTree& tree, const Box& box, const Vec3& p) {
    const Jet side = within(box, p);
    const Jet jet = evaluate(tree, 0, p, -std::numeric_limits<double>::infinity(), side.value);
    return side.value < jet.value ? side : jet;
}

// How far ∇q gets from its value at the centre of the box, at most.
double turn(const Quadric& q, const Vec3& half) {
    const auto& c = q.c;
    return norm(Vec3{2 * std::abs(c[0]) * half.x + std::abs(c[3]) * half.y + std::abs(c[4]) * half.z,
                     std::abs(c[3]) * half.x + 2 * std::abs(c[1]) * half.y + std::abs(c[5]) * half.z,
                     std::abs(c[4]) * half.x + std::abs(c[5]) * half.y + 2 * std::abs(c[2]) * half.z});
}

// Signed distances of `ask` over a box.
Interval range_of_question(const SetTree& tree, const TreeNode& node, const Box& box) {
    if (node.kind == TreeNode::Kind::cut) return {box.lo[node.axis] - node.cut, box.hi[node.axis] - node.cut};
    const Quadric& q = tree.quadrics[static_cast<std::size_t>(node.quadric)].quadric;
    const Interval s = cell_range(in_frame_of(q, box));
    const double slope = norm(q.gradient(box.centre())), by = turn(q, box.extent() * 0.5);
    const double least = std::max((slope - by) * (1 - 1e-12), kLeastSlope);
    const double most = std::max((slope + by) * (1 + 1e-12), kLeastSlope);
    return {s.lo / (s.lo < 0 ? least : most), s.hi / (s.hi > 0 ? least : most)};
}

// The same form over intervals. Where the answer is certain the other subtree can only come in between ±m and
// T.
Interval range_of(const SetTree& tree, std::int32_t index, const Box& box) {
    const TreeNode& node = tree.nodes[static_cast<std::size_t>(index)];
    if (node.leaf()) {
        const double value = node.kind == TreeNode::Kind::inside ? kEverywhere : -kEverywhere;
        return {value, value};
    }
    const Interval s = range_of_question(tree, node, box);
    if (s.lo >= 0 || s.hi < 0) {
        const double distance = s.lo >= 0 ? s.lo : -s.hi;
        const Interval taken = range_of(tree, s.lo >= 0 ? node.high : node.low, box);
        return {std::min(distance, taken.lo), std::max(taken.hi, -std::max(distance, kLeastDistance))};
    }
    const Interval high = range_of(tree, node.high, box), low = range_of(tree, node.low, box);
    return {std::max({std::min(s.lo, high.lo), std::min(-s.hi, low.lo), std::min(high.lo, low.lo)}),
            std::max({std::min(s.hi, high.hi), std::min(-s.lo, low.hi), std::min(high.hi, low.hi)})};
}

}  // namespace

double TreeField::value(const Vec3& p) const {
    return evaluate(tree_, box_, p).value;
}

double TreeField::value_and_gradient(const Vec3& p, Vec3& gradient) const {
    const Jet jet = evaluate(tree_, box_, p);
    gradient = jet.gradient;
    return jet.value;
}

Interval TreeField::range(const Box& box) const {
    const Interval sides = within(box_, box), tree = range_of(tree_, 0, box);
    return {std::min(sides.lo, tree.lo), std::min(sides.hi, tree.hi)};
}

}  // namespace pfgeom
