// A function within a box: only the balls that reach into it. What is left out is exactly 0 there, and the
// rest is added in the same order, so values are those of the whole function, bit for bit.
#pragma once

#include "pfgeom/base/pair.h"
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
    // Two points at a time.
    void values(std::span<const Vec3> points, std::span<double> values) const override;
    void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                              std::span<Vec3> gradients) const override;
    void tangents(std::span<const Box> boxes, std::span<Tangent> tangents) const override;

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
    // Of two points in the box.
    std::array<double, 2> values_of(const Vec3& a, const Vec3& b) const;
    std::array<Jet, 2> jets_of(const Vec3& a, const Vec3& b) const;
    // Of the second derivatives xx, yy, zz, xy, xz, yz, but for the perturbations'.
    std::array<Pair, 6> bends_of(const Vec3& a, const Vec3& b) const;
    std::array<double, 2> errors_of(const Box& a, const Box& b) const;
    // All but the balls.
    double smooth_value(const Vec3& p) const;
    Jet smooth_jet(const Vec3& p) const;
    bool smooth_in(const Box& box) const;

    const FunctionField& whole_;
    Box box_;
    std::vector<Perturbation> perturbations_;
    std::vector<Ball> balls_;
    std::vector<Part> parts_;  // by level
    // The largest second and third derivatives in the box, along any line, but for the perturbations'.
    double bend_ = 0, twist_ = 0;
};

/// Of a quadric, in any direction.
double largest_bend(const Quadric& q);
/// Of the sum of perturbations.
Interval sum_over(std::span<const Perturbation> perturbations, const Box& box);
/// Of a function with its jet at the centre of a box that is off by `error` at most, but for rounding.
Tangent tangent_of(const Jet& jet, double error, const Vec3& half);

}  // namespace pfgeom
