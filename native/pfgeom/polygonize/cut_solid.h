// What the cutting polygonizer takes: a set expression over decision trees whose questions are the signs of
// smooth functions, quadrics mostly.
#pragma once

#include "pfgeom/eval/pruned_tree.h"
#include "pfgeom/eval/scalar_field.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pfgeom {

/// In depth-first order: the high child, or an operation's first operand, is the next node.
struct SolidNode {
    static constexpr std::int32_t kLeaf = -1, kUnite = -2, kIntersect = -3, kComplement = -4;

    std::int32_t question = kLeaf;  ///< or one of the above
    std::int32_t low = -1;          ///< the low child, or the second operand
    bool inside = false;            ///< of a leaf
};

/// A field as a question.
struct SmoothQuestion {
    std::shared_ptr<const ScalarField> field;
    double cell = 0;   ///< the edges of cells in which it may be zero are no longer
    double slope = 0;  ///< values of points differ by at most this times their distance; 0: not known
};

class CutSolid {
  public:
    CutSolid() = default;
    explicit CutSolid(const TreePruner& tree);

    std::int32_t add(const Quadric& question);
    std::int32_t add(SmoothQuestion question);
    std::vector<SolidNode>& nodes() { return nodes_; }

    const std::vector<SolidNode>& whole() const { return nodes_; }
    std::size_t questions() const { return quadrics_.size(); }
    bool is_quadric(std::int32_t question) const { return !fields_[question].field; }
    const Quadric& quadric(std::int32_t question) const { return quadrics_[question]; }
    const SmoothQuestion& smooth(std::int32_t question) const { return fields_[question]; }

    double value(std::int32_t question, const Vec3& p) const {
        const auto& field = fields_[question].field;
        return field ? field->value(p) : quadrics_[question].value(p);
    }
    Vec3 gradient(std::int32_t question, const Vec3& p) const {
        Vec3 gradient;
        value(question, p, gradient);
        return gradient;
    }
    double value(std::int32_t question, const Vec3& p, Vec3& gradient) const {
        const auto& field = fields_[question].field;
        if (field) return field->value_and_gradient(p, gradient);
        gradient = quadrics_[question].gradient(p);
        return quadrics_[question].value(p);
    }

    /// Are there operations? Else a point ends in one leaf.
    bool combined() const { return combined_; }
    /// Is p inside? Appends the leaves that say so.
    bool contains(const Vec3& p, std::vector<std::int32_t>& leaves) const { return contains(0, p, leaves); }
    /// To be called once the nodes are there.
    void finish();

  private:
    bool contains(std::int32_t node, const Vec3& p, std::vector<std::int32_t>& leaves) const;

    std::vector<Quadric> quadrics_;       // by question; of a field: nothing
    std::vector<SmoothQuestion> fields_;  // by question; of a quadric: nothing
    std::vector<SolidNode> nodes_;
    bool combined_ = false;
};

}  // namespace pfgeom
