// A set-theoretic expression over functions as one field: union max, intersection min, complement negation
// (paper eq. 6, 7 with ψ = max, min).
#pragma once

#include "pfgeom/eval/function_field.h"
#include "pfgeom/eval/scalar_field.h"

#include <vector>

namespace pfgeom {

class SolidField final : public ScalarField {
  public:
    /// Takes the functions that the solid's nodes name out of the model.
    SolidField(const Model& model, const Solid& solid);

    double value(const Vec3& p) const override;
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override;
    Interval range(const Box& box) const override;
    Tangent tangent(const Box& box) const override {
        return single() ? single()->tangent(box) : ScalarField::tangent(box);
    }
    std::unique_ptr<const ScalarField> pruned(const Box& box) const override {
        return single() ? single()->pruned(box) : nullptr;
    }

  private:
    // The function, if there are no operations.
    const FunctionField* single() const {
        return nodes_.size() == 1 && nodes_[0].kind == SetNode::Kind::function ? &field(nodes_[0].a)
                                                                               : nullptr;
    }
    Jet jet(const Vec3& p, std::int32_t index) const;
    double value(const Vec3& p, std::int32_t index) const;
    Interval range(const Box& box, std::int32_t index) const;
    const FunctionField& field(std::int32_t function) const;
    std::int32_t root() const { return static_cast<std::int32_t>(nodes_.size()) - 1; }

    std::vector<SetNode> nodes_;
    std::vector<FunctionField> fields_;
    std::vector<std::int32_t> field_of_;  // function -> row of fields_, or -1
};

}  // namespace pfgeom
