// A function in a cell: the perturbations that are not zero throughout it, and how far it can bend there.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/eval/function_field.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// The terms of one function in one list: perturbations by any quadrics first, then the balls of all levels.
class FunctionTerms {
  public:
    explicit FunctionTerms(const Function& function);

    struct Ball {
        Vec3 centre;
        double inverse_squared = 0, factor = 0;
    };
    const Quadric& base() const { return base_; }
    std::size_t perturbation_count() const { return perturbations_.size(); }
    std::size_t count() const { return perturbations_.size() + balls_.size(); }
    const Perturbation& perturbation(std::size_t i) const { return perturbations_[i]; }
    const Ball& ball(std::size_t i) const { return balls_[i - perturbations_.size()]; }

    /// Of the function at a point where no terms but `live` (in rising order) are other than zero: the same
    /// bits as FunctionField gives, since exact zeros are left out.
    double value(const Vec3& p, std::span<const std::int32_t> live) const;
    Jet jet(const Vec3& p, std::span<const std::int32_t> live) const;

  private:
    Quadric base_;
    std::vector<Perturbation> perturbations_;
    std::vector<Ball> balls_;
};

/// What holds in a box.
struct CellFunction {
    Interval range;         ///< of the function
    double bend = 0;        ///< the norm of its Hessian is at most this
    double added_bend = 0;  ///< … that of the terms together, without the base quadric
    /// The function is within `error` of linear.value + linear.gradient · (p - centre).
    Vec3 centre;
    Jet linear;
    double error = 0;
    std::vector<std::int32_t> live;  ///< terms that are not zero throughout, rising
};

/// `live`: the terms that may be other than zero in the box.
CellFunction look_at_cell(const FunctionTerms& terms, std::span<const std::int32_t> live, const Box& box);

}  // namespace pfgeom
