// A set tree as one field: F = (S ∩ H) ∪ (¬S ∩ L) as max(min(S, H), min(-S, L)). Source: Ricci, "A
// constructive geometry for computer graphics", The Computer Journal 16, 1973. Departure: the consensus term
// min(H, L) joins the maximum, without which a question between two insides would put a zero into their
// common interior.
#pragma once

#include "pfgeom/eval/scalar_field.h"
#include "pfgeom/function/set_tree.h"

namespace pfgeom {

/// Value: about the distance to the nearest of the surfaces that decide, in the cube's units; >= 0 exactly
/// where contains(tree, p). Gradient: that of the quadric, cut or side of the box that the value comes from,
/// of unit length where it is not singular. `complement` is not applied.
class TreeField final : public ScalarField {
  public:
    explicit TreeField(const SetTree& tree) : tree_(tree), box_(tree.box()) {}

    double value(const Vec3& p) const override;
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override;
    /// Its sign is as sharp as pruning by single questions allows.
    Interval range(const Box& box) const override;

    const SetTree& tree() const { return tree_; }

  private:
    SetTree tree_;
    Box box_;
};

}  // namespace pfgeom
