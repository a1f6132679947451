// What a decision tree can still say within a box: questions that a conservative range answers are dropped.
#pragma once

#include "pfgeom/function/set_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

struct PrunedNode {
    std::int32_t question = -1;  ///< of the pruner; -1: a leaf
    std::int32_t low = -1;       ///< the high child is the next node
    std::int32_t leaf = -1;      ///< of a leaf: its row in SetTree::nodes; -1: several, or outside the box
    bool inside = false;         ///< of a leaf
};

/// In depth-first order, the high child first; node 0 is the root.
using PrunedTree = std::vector<PrunedNode>;

/// What holds everywhere in a region: the quadric is >= 0 (high) or < 0 there.
struct KnownAnswer {
    Quadric quadric;
    bool high = true;
};

/// { p : dot(normal, p) >= offset }.
KnownAnswer known_half_space(const Vec3& normal, double offset);

/// The questions of a tree, those of its cuts and its box among them, as quadrics. Immutable, safe to use
/// from many threads.
class TreePruner {
  public:
    explicit TreePruner(const SetTree& tree);

    const PrunedTree& whole() const { return whole_; }
    const Quadric& quadric(std::int32_t question) const { return questions_[question].quadric; }
    std::size_t questions() const { return questions_.size(); }

    /// What is left of `tree` at the points of the box where all of `known` holds; `tree` must be right
    /// there. `paired`: answers given on the path from the root answer later questions, too, as `known`
    /// always does.
    void prune(const PrunedTree& tree, const Box& box, bool paired, std::span<const KnownAnswer> known,
               PrunedTree& out) const;

    /// The node that p ends at: a leaf.
    const PrunedNode& leaf_at(const PrunedTree& tree, const Vec3& p) const {
        std::int32_t i = 0;
        while (tree[i].question >= 0) i = quadric(tree[i].question).value(p) >= 0 ? i + 1 : tree[i].low;
        return tree[i];
    }
    bool contains(const PrunedTree& tree, const Vec3& p) const { return leaf_at(tree, p).inside; }

  private:
    friend class Pruning;
    struct Question {
        Quadric quadric;
        double rounding;  // what the computed values may be off by
    };
    std::int32_t add(const Quadric& quadric);

    std::vector<Question> questions_;
    PrunedTree whole_;
};

}  // namespace pfgeom
