#include "pfgeom/function/check.h"
#include "pfgeom/function/quadric_family.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfgeom {
namespace {

using Flaw = std::string;  // empty: none

Flaw flaw_of(const TreeQuadric& q) {
    if (q.family >= kQuadricFamilies) return "a quadric's family does not exist";
    const QuadricFamily& family = quadric_families()[q.family];
    if (q.linear_shift > (family.has_linear_shift() ? kMostShift : 0)) return "a linear shift is too large";
    if (q.square_shift > (family.has_squares() ? kMostShift : 0)) return "a square shift is too large";
    for (std::size_t i = 0; i < q.n.size(); ++i) {
        const std::int32_t most = i < family.size ? kMostQuadricInteger : 0;
        if (q.n[i] < -most || q.n[i] > most) return "a quadric's integer is out of range";
    }
    if (family.kind == FamilyKind::axis_plane && q.n[0] != 1 && q.n[0] != -1) {
        return "the direction of an axis plane is not 1 or -1";
    }
    return {};
}

// Largest |coordinate| of the box: the cube's, and a rounding beyond it.
bool is_in_cube(const SetTree& tree, std::size_t axis) {
    const std::int32_t most = (2 << tree.resolution) + 1;
    return tree.low[axis] >= -most && tree.low[axis] < tree.high[axis] && tree.high[axis] <= most;
}

// Walks the nodes in their order with the path to the present one.
class NodeCheck {
  public:
    explicit NodeCheck(const SetTree& tree) : tree_(tree), asked_(tree.quadrics.size(), false) {}

    Flaw run() {
        const auto count = static_cast<std::int32_t>(tree_.nodes.size());
        for (std::int32_t i = 0; i < count; ++i) {
            if (i > 0 && path_.empty()) return "a node does not hang in the tree";
            const TreeNode& node = tree_.nodes[static_cast<std::size_t>(i)];
            if (Flaw flaw = node.leaf() ? Flaw{} : enter(node, i); !flaw.empty()) return flaw;
            if (node.leaf() && !leave_up_to(i + 1)) return "a node's low child does not follow its high one";
        }
        if (!path_.empty()) return "a node's child does not exist";
        return seen_ == tree_.quadrics.size() ? Flaw{} : "a quadric is not used";
    }

  private:
    struct Step {
        const TreeNode* node;
        bool at_low;
    };

    Flaw enter(const TreeNode& node, std::int32_t index) {
        if (path_.size() >= kMaxTreeDepth) return "its tree is too deep";
        if (node.high != index + 1) return "a node's high child does not follow it";
        path_.push_back({&node, false});
        if (node.kind == TreeNode::Kind::cut) {
            const int positions = node.fine ? kFineCuts : kCoarseCuts;
            if (node.axis > 2 || node.position == 0 || node.position >= positions)
                return "a cut is out of range";
            return {};
        }
        if (node.kind != TreeNode::Kind::ask) return "a node's kind does not exist";
        const auto q = static_cast<std::size_t>(node.quadric);
        if (node.quadric < 0 || q > seen_ || q >= tree_.quadrics.size()) {
            return "a quadric does not exist, or stands not where it is first used";
        }
        if (asked_[q]) return "a quadric is asked twice on a path";
        if (q == seen_) ++seen_;
        asked_[q] = true;
        return {};
    }

    // After a leaf: up to the first question whose low side is still to come; it must be node `next`.
    bool leave_up_to(std::int32_t next) {
        while (!path_.empty() && path_.back().at_low) {
            const TreeNode& node = *path_.back().node;
            if (node.kind == TreeNode::Kind::ask) asked_[static_cast<std::size_t>(node.quadric)] = false;
            path_.pop_back();
        }
        if (path_.empty()) return true;
        path_.back().at_low = true;
        return path_.back().node->low == next;
    }

    const SetTree& tree_;
    std::vector<bool> asked_;
    std::vector<Step> path_;
    std::size_t seen_ = 0;  // quadrics
};

}  // namespace

std::string find_flaw(const SetTree& tree) {
    if (tree.resolution > kMostResolution) return "its tree's resolution is too fine";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!is_in_cube(tree, axis)) return "its tree's box is empty or leaves the cube";
    }
    for (const TreeQuadric& q : tree.quadrics) {
        if (Flaw flaw = flaw_of(q); !flaw.empty()) return flaw;
    }
    if (tree.nodes.empty()) return "its tree is empty";
    return NodeCheck(tree).run();
}

}  // namespace pfgeom
