// A function within a box: only the balls that reach into it. What is left out is exactly 0 there, and the
// rest is added in the same order, so values are those of the whole function, bit for bit.
#pragma once

#include "pfgeom/eval/function_field.h"

namespace pfgeom {

class PrunedFunction final : public ScalarField {
  public:
    /// `whole` must outlive it.
    PrunedFunction(const FunctionField& whole, const Box& box);

    double value(const Vec3& p) const override;
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override;
    Interval range(const Box& box) const override { return tangent(box).over({}, box.extent() * 0.5); }
    Tangent tangent(const Box& box) const override;

  private:
    struct Ball {
        Vec3 centre;
        double factor = 0;
    };
    struct Part {
        double inverse_squared = 0;  // of the radius
        std::size_t end = 0;         // of its balls
    };
    void add(const LevelField& level);

    const FunctionField& whole_;
    Box box_;
    std::vector<Perturbation> perturbations_;
    std::vector<Ball> balls_;
    std::vector<Part> parts_;  // by level
    double bend_ = 0;          // the largest second derivative in the box, but for the perturbations'
};

/// Of a quadric, in any direction.
double largest_bend(const Quadric& q);
/// Of the sum of perturbations.
Interval sum_over(std::span<const Perturbation> perturbations, const Box& box);
/// Of a smooth function with its jet at the centre of a box and a second derivative of at most `bend`, and
/// another one between the bounds.
Tangent tangent_of(const Jet& smooth, double bend, const Interval& other, const Vec3& half);

}  // namespace pfgeom
