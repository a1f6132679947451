// Small set trees for tests: named parts of them, and seeded ones of every family and kind of question.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/function/quadric_family.h"
#include "pfgeom/function/set_tree.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pfgeom::test {

inline TreeNode leaf(bool inside) {
    TreeNode node;
    node.kind = inside ? TreeNode::Kind::inside : TreeNode::Kind::outside;
    return node;
}

inline TreeNode with_children(TreeNode node, std::int32_t high, std::int32_t low) {
    node.high = high;
    node.low = low;
    return node;
}

inline TreeNode ask(std::int32_t quadric, std::int32_t high, std::int32_t low) {
    TreeNode node;
    node.kind = TreeNode::Kind::ask;
    node.quadric = quadric;
    return with_children(node, high, low);
}

inline TreeQuadric of_family(std::uint8_t family, const std::array<std::int32_t, 10>& n) {
    TreeQuadric q;
    q.family = family;
    q.n = n;
    return q;
}

/// A tree without nodes on [-half, half]³, half in units of 2^-(resolution + 1).
inline SetTree box_tree(int resolution, std::int32_t half) {
    SetTree tree;
    tree.resolution = static_cast<std::uint8_t>(resolution);
    tree.low = {-half, -half, -half};
    tree.high = {half, half, half};
    return tree;
}

inline TreeQuadric random_tree_quadric(Random& random) {
    TreeQuadric q;
    q.family = static_cast<std::uint8_t>(random.below(kQuadricFamilies));
    const QuadricFamily& family = quadric_families()[q.family];
    if (family.has_linear_shift()) q.linear_shift = static_cast<std::uint8_t>(random.below(6));
    if (family.has_squares()) q.square_shift = static_cast<std::uint8_t>(random.below(5));
    for (int i = 0; i < family.size; ++i) {
        const auto width = random.below(12);
        const auto n = static_cast<std::int32_t>(random.below(std::uint64_t{1} << width));
        q.n[static_cast<std::size_t>(i)] = random.below(2) == 0 ? n : -n;
    }
    if (family.kind == FamilyKind::axis_plane) q.n[0] = random.below(2) == 0 ? 1 : -1;
    return q;
}

class TreeMaker {
  public:
    TreeMaker(Random& random, SetTree& tree) : random_(random), tree_(tree) {}

    std::int32_t make(int depth) {
        const auto index = static_cast<std::int32_t>(tree_.nodes.size());
        tree_.nodes.push_back(leaf(random_.below(2) == 0));
        if (depth == 0 || (index > 0 && random_.below(5) == 0)) return index;
        TreeNode node = random_.below(3) == 0 ? cut() : question();
        if (node.quadric >= 0) path_.push_back(node.quadric);
        node.high = make(depth - 1);
        node.low = make(depth - 1);
        if (node.quadric >= 0) path_.pop_back();
        tree_.nodes[static_cast<std::size_t>(index)] = node;
        return index;
    }

  private:
    TreeNode cut() {
        TreeNode node;
        node.kind = TreeNode::Kind::cut;
        node.axis = static_cast<std::uint8_t>(random_.below(3));
        node.fine = random_.below(4) == 0;
        const int positions = node.fine ? kFineCuts : kCoarseCuts;
        node.position =
            static_cast<std::uint16_t>(1 + random_.below(static_cast<std::uint64_t>(positions - 1)));
        return node;
    }

    // A new quadric half of the time, else any one that the path has not asked.
    TreeNode question() {
        TreeNode node;
        node.kind = TreeNode::Kind::ask;
        const std::size_t known = tree_.quadrics.size();
        if (known > 0) node.quadric = static_cast<std::int32_t>(random_.below(known));
        const bool asked = std::find(path_.begin(), path_.end(), node.quadric) != path_.end();
        if (known == 0 || asked || random_.below(2) == 0) {
            node.quadric = static_cast<std::int32_t>(known);
            tree_.quadrics.push_back(random_tree_quadric(random_));
        }
        return node;
    }

    Random& random_;
    SetTree& tree_;
    std::vector<std::int32_t> path_;
};

/// Well formed, of up to 2^(depth + 1) - 1 nodes, at least one question.
inline SetTree random_tree(Random& random, int depth) {
    SetTree tree = box_tree(8 + static_cast<int>(random.below(6)), 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint64_t most = std::uint64_t{2} << tree.resolution;
        tree.low[axis] = -static_cast<std::int32_t>(1 + random.below(most));
        tree.high[axis] = static_cast<std::int32_t>(random.below(most));
    }
    tree.complement = random.below(2) == 0;
    TreeMaker(random, tree).make(depth);
    derive(tree);
    return tree;
}

}  // namespace pfgeom::test
