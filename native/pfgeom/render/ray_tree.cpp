// On a ray a quadric is a parabola, so a decision tree cuts it exactly: at a node the ray's span falls into
// up to three parts, each with an answer. Source: Roth, "Ray casting for modeling solids", 1982. Departure:
// the parts are walked in order, as far as the first change of sides.
#include "pfgeom/render/ray_tree.h"

#include "pfgeom/render/local_extreme.h"
#include "pfgeom/render/make_octree.h"
#include "pfgeom/render/parabola.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace pfgeom {
namespace {

// A cell is cut no further when it asks no more than kFewQuestions, or at this depth. CPU seconds of drawing
// fandisk and featuretype (24 and 59 quadrics) at 1024² with 2 and 6: 0.160, 0.143; 3 and 6: 0.155, 0.139; 2
// and 5: 0.161, 0.145; 4 and 5: 0.149, 0.136, but a looser fit of the camera.
constexpr int kFewQuestions = 3, kDepth = 6;

class LeafCut {
  public:
    LeafCut(const TreePruner& pruner, std::span<const PrunedNode> nodes, const Ray& ray)
        : pruner_(pruner), nodes_(nodes), ray_(ray) {}

    LeafAnswer run(const RaySpan& span) {
        walk(0, span.from, span.to, -1);
        answer_.ends_inside = answer_.begins_inside;
        return answer_;
    }

  private:
    // True at the first change of sides. `question`: the one that changes its answer at `from`.
    bool walk(std::size_t index, double from, double to, std::int32_t question) {
        const PrunedNode& node = nodes_[index];
        if (node.question < 0) return end(node.inside, from, question);
        const Parabola parabola(pruner_.quadric(node.question), ray_);
        std::array<double, 2> roots{};
        const int count = parabola.roots(roots);
        for (int i = 0; i <= count; ++i) {
            double until = to;
            if (i < count) {
                until = roots[static_cast<std::size_t>(i)];
                if (!(until > from && until < to)) continue;
            }
            const bool high = parabola.is_high(from + (until - from) / 2);
            if (walk(high ? index + 1 : static_cast<std::size_t>(node.low), from, until, question))
                return true;
            from = until;
            question = node.question;
        }
        return false;
    }

    bool end(bool inside, double from, std::int32_t question) {
        if (question < 0) answer_.begins_inside = inside;
        if (inside == answer_.begins_inside) return false;
        answer_.hit = {from, inside ? -ray_.direction : ray_.direction, -1, question};
        return true;
    }

    const TreePruner& pruner_;
    std::span<const PrunedNode> nodes_;
    const Ray& ray_;
    LeafAnswer answer_;
};

// The tree without the questions about its box, which the octree's box answers, and the leaf outside of it.
PrunedTree without_box(const PrunedTree& whole) {
    constexpr std::int32_t kSides = 6;
    PrunedTree inner(whole.begin() + kSides, whole.end() - 1);
    for (PrunedNode& node : inner) node.low -= node.question >= 0 ? kSides : 0;
    return inner;
}

}  // namespace

RayTree::RayTree(const SetTree& tree, const Frame& frame, const Task& task)
    : place_(frame), pruner_(tree), quadrics_(tree.quadrics.size()) {
    octree_.box = tree.box();
    make(task);
}

void RayTree::make(const Task& task) {
    const auto look = [&](const PrunedTree& parent, const Box& cell, int depth, PrunedTree& left) {
        task.check();
        pruner_.prune(parent, widened(cell, kReach), true, {}, left);
        const std::size_t questions = left.size() / 2;
        if (questions == 0) return left[0].inside ? CellFate::inside : CellFate::outside;
        return questions <= kFewQuestions || depth == kDepth ? CellFate::leaf : CellFate::split;
    };
    const auto keep = [&](const PrunedTree& left) {
        first_.push_back(static_cast<std::int32_t>(nodes_.size()));
        nodes_.insert(nodes_.end(), left.begin(), left.end());
        return static_cast<std::int32_t>(first_.size()) - 1;
    };
    const auto weigh = [](const PrunedTree& left) { return static_cast<double>(left.size()); };
    octree_ = make_octree(octree_.box, without_box(pruner_.whole()), task, look, keep, weigh);
}

SurfaceHit RayTree::first_hit(const Ray& world, const RaySpan& span) const {
    const LocalRay local(place_, world, span, octree_.box.centre());
    const auto ask = [&](std::int32_t leaf, const RaySpan& part) {
        return LeafCut(pruner_, nodes_of(leaf), local.ray()).run(part);
    };
    return local.to_world(with_normal(first_hit_in(octree_, local.ray(), local.span(), ask), local.ray()));
}

// `hit.function` is a question as yet; a side of the box has its normal.
SurfaceHit RayTree::with_normal(SurfaceHit hit, const Ray& ray) const {
    if (hit.function < 0) return hit;
    hit.normal = along(pruner_.quadric(hit.function).gradient(ray.at(hit.t)), hit.normal);
    if (static_cast<std::size_t>(hit.function) >= quadrics_) hit.function = -1;
    return hit;
}

Extreme RayTree::extreme(const SearchGoal& goal, double within, double accuracy,
                         ExtremeSearch& search) const {
    return extreme_in(place_, *this, goal, within, accuracy, search);
}

// Each path to an end of that side is a region.
void RayTree::regions(std::int32_t leaf, Side side, std::vector<SignRegion>& regions) const {
    regions.clear();
    const std::span<const PrunedNode> nodes = nodes_of(leaf);
    std::vector<std::pair<std::int32_t, SignRegion>> open{{0, {}}};
    while (!open.empty()) {
        const auto [index, region] = open.back();
        open.pop_back();
        const PrunedNode& node = nodes[static_cast<std::size_t>(index)];
        if (node.question < 0) {
            if (node.inside == (side == Side::inside)) regions.push_back(region);
            continue;
        }
        open.emplace_back(node.low, region).second.add({node.question, Sense::negative});
        open.emplace_back(index + 1, region).second.add({node.question, Sense::positive});
    }
}

Expansion RayTree::expand(std::int32_t /*leaf*/, std::int32_t function, const Vec3& at) const {
    const Quadric& quadric = pruner_.quadric(function);
    Expansion expansion{quadric.value(at), quadric.gradient(at), {}, {}};
    set_curvature(quadric, 0, expansion);
    return expansion;
}

bool RayTree::is_inside(std::int32_t leaf, const Vec3& p) const {
    const std::span<const PrunedNode> nodes = nodes_of(leaf);
    std::size_t i = 0;
    while (nodes[i].question >= 0)
        i = pruner_.quadric(nodes[i].question).value(p) >= 0 ? i + 1 : static_cast<std::size_t>(nodes[i].low);
    return nodes[i].inside;
}

std::vector<Box> RayTree::cover() const {
    return cover_in(place_, octree_);
}

}  // namespace pfgeom
