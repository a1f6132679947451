// The evaluator of one function: base quadric + Σ f_i max(Q_i, 0)³ (paper eq. 4, 5).
#pragma once

#include "pfgeom/eval/ball_grid.h"
#include "pfgeom/eval/scalar_field.h"
#include "pfgeom/eval/sum_bounds.h"
#include "pfgeom/function/model.h"

#include <vector>

namespace pfgeom {

/// A value with its gradient.
struct Jet {
    double value = 0;
    Vec3 gradient;
};

/// Balls of one radius with their form factors; those that are zero are left out.
class LevelField {
  public:
    explicit LevelField(const Level& level);

    void add_value(const Vec3& p, double& sum) const {
        for (const BallGrid::Entry& e : grid_.candidates(p)) {
            const double q = 1 - squared_norm(p - e.centre) * inverse_squared_;
            if (q > 0) sum += factors_[static_cast<std::size_t>(e.ball)] * (q * q * q);
        }
    }
    void add_jet(const Vec3& p, Jet& jet) const {
        for (const BallGrid::Entry& e : grid_.candidates(p)) {
            const Vec3 d = p - e.centre;
            const double q = 1 - squared_norm(d) * inverse_squared_;
            if (q <= 0) continue;
            const double fq2 = factors_[static_cast<std::size_t>(e.ball)] * (q * q);
            jet.value += fq2 * q;
            jet.gradient += (-6 * inverse_squared_ * fq2) * d;  // ∇q³ = 3 q² ∇q, ∇q = -2 d / r²
        }
    }
    const BallGrid& grid() const { return grid_; }
    const SumBounds& bounds() const { return bounds_; }
    double factor(std::int32_t ball) const { return factors_[static_cast<std::size_t>(ball)]; }
    double radius() const { return grid_.radius(); }
    double inverse_squared() const { return inverse_squared_; }

  private:
    std::vector<double> factors_;
    BallGrid grid_;
    SumBounds bounds_;
    double inverse_squared_ = 0;
};

/// Grows by levels while a hierarchy is fitted or decoded; immutable (and thread-safe) between.
class FunctionField final : public ScalarField {
  public:
    explicit FunctionField(const Quadric& base) : base_(base) {}
    explicit FunctionField(const Function& function);

    void add(const Level& level) { levels_.emplace_back(level); }
    void add(const Perturbation& perturbation) { perturbations_.push_back(perturbation); }

    double value(const Vec3& p) const override;
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override;
    Interval range(const Box& box) const override;
    Tangent tangent(const Box& box) const override;
    std::unique_ptr<const ScalarField> pruned(const Box& box) const override;

    Jet jet(const Vec3& p) const;
    /// Trace of the curvature of the level set through p (twice the mean curvature), > 0 where it is concave
    /// seen from inside; gradients below 0.1 count as 0.1.
    double curvature(const Vec3& p) const;

    std::size_t level_count() const { return levels_.size(); }
    const LevelField& level(std::size_t i) const { return levels_[i]; }
    const Quadric& base() const { return base_; }
    const std::vector<Perturbation>& perturbations() const { return perturbations_; }

  private:
    Quadric base_;
    std::vector<Perturbation> perturbations_;
    std::vector<LevelField> levels_;
};

}  // namespace pfgeom
