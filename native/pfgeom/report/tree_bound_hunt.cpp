// From the centre, Newton steps onto one violated condition after the other of a leaf's path (Agmon, "The
// relaxation method for linear inequalities", 1954, with quadrics for planes), aiming a margin beyond each.
#include "pfgeom/report/tree_bound_hunt.h"

#include "pfgeom/function/moved_box.h"

namespace pfgeom {
namespace {

constexpr int kSweeps = 40;
constexpr double kMargins[] = {0.05, 0.005, 0.0005};  // of the box's size: thin slivers need small ones
constexpr double kEnough = 0.2;                       // of the margin: a condition counts as met

struct Condition {
    std::int32_t question;
    bool high;
};

class Hunt {
  public:
    Hunt(const TreePruner& pruner, const PrunedTree& tree, const Box& box, bool wrong,
         std::vector<Vec3>& points)
        : pruner_(pruner), tree_(tree), box_(box), wrong_(wrong), points_(points) {}

    bool add_if_wrong(const Vec3& p) {
        if (pruner_.contains(tree_, p) != wrong_) return false;
        points_.push_back(p);
        return true;
    }

    void walk_to_leaves(std::int32_t node) {
        if (tree_[node].question < 0) {
            if (tree_[node].inside != wrong_) return;
            for (const double margin : kMargins)
                if (add_if_wrong(walk(margin * box_.diagonal() / 2))) break;
            return;
        }
        path_.push_back({tree_[node].question, true});
        walk_to_leaves(node + 1);
        path_.back().high = false;
        walk_to_leaves(tree_[node].low);
        path_.pop_back();
    }

  private:
    // To a point of the box where the conditions of the path hold, if the walk gets there.
    Vec3 walk(double margin) const {
        Vec3 p = box_.centre();
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            bool all = true;
            for (const Condition& condition : path_) {
                const Quadric& quadric = pruner_.quadric(condition.question);
                const double sign = condition.high ? 1 : -1, value = sign * quadric.value(p);
                const Vec3 gradient = sign * quadric.gradient(p);
                const double slope = norm(gradient);
                if (!(slope > 1e-9) || value > kEnough * margin * slope) continue;
                all = false;
                p += gradient * ((margin * slope - value) / (slope * slope));
            }
            if (all) break;
        }
        return max(min(p, box_.hi), box_.lo);
    }

    const TreePruner& pruner_;
    const PrunedTree& tree_;
    const Box& box_;
    bool wrong_;
    std::vector<Vec3>& points_;
    std::vector<Condition> path_;
};

}  // namespace

void hunt_label(const TreePruner& pruner, const PrunedTree& tree, const Box& box, bool wrong,
                std::vector<Vec3>& points) {
    Hunt hunt(pruner, tree, box, wrong, points);
    bool any = hunt.add_if_wrong(box.centre());
    for (unsigned corner = 0; corner < 8; ++corner) any = hunt.add_if_wrong(corner_of(box, corner)) || any;
    if (!any) hunt.walk_to_leaves(0);
}

}  // namespace pfgeom
