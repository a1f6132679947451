// A field seen through an affine map.
#pragma once

#include "pfgeom/eval/scalar_field.h"
#include "pfgeom/function/affine.h"

#include <memory>
#include <utility>

namespace pfgeom {

/// field(map(p)) of p.
class PlacedField final : public ScalarField {
  public:
    PlacedField(std::shared_ptr<const ScalarField> field, const Affine& map)
        : field_(std::move(field)), map_(map) {}

    double value(const Vec3& p) const override { return field_->value(map_.apply(p)); }
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override {
        const double value = field_->value_and_gradient(map_.apply(p), gradient);
        gradient = map_.pull(gradient);
        return value;
    }
    Interval range(const Box& box) const override {
        const Vec3 centre = map_.apply(box.centre()), half = box.extent() * 0.5;
        Vec3 reach;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3& row = map_.rows[static_cast<std::size_t>(axis)];
            reach[axis] = (std::abs(row.x) * half.x + std::abs(row.y) * half.y + std::abs(row.z) * half.z) *
                              (1 + 1e-12) +
                          1e-15 * std::abs(centre[axis]);
        }
        return field_->range({centre - reach, centre + reach});
    }

  private:
    std::shared_ptr<const ScalarField> field_;
    Affine map_;
};

}  // namespace pfgeom
