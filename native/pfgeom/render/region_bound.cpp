// Source: Boyd, Vandenberghe, "Convex Optimization", 2004, ch. 5 (weak duality holds without convexity).
#include "pfgeom/render/region_bound.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// A multiplier is found to some digits: any value bounds, and the next round of models starts better.
constexpr int kSteps = 12, kDoublings = 40;
// Rounds over the multipliers where there are several; right angles need one.
constexpr int kRounds = 3;

// Of ½ a t² + b t over [lo, hi].
double minimiser(double a, double b, double lo, double hi) {
    if (a > 0) return std::clamp(-b / a, lo, hi);
    return (0.5 * a * hi + b) * hi < (0.5 * a * lo + b) * lo ? hi : lo;
}

double greatest(const LocalCondition& c, const Vec3& lo, const Vec3& hi) {
    double sum = c.value;
    for (int axis = 0; axis < 3; ++axis) {
        const double t = minimiser(-c.upper[axis], -c.gradient[axis], lo[axis], hi[axis]);
        sum += (0.5 * c.upper[axis] * t + c.gradient[axis]) * t;
    }
    return sum;
}

// The Lagrangian ½|x + t - p|² (or -e·(x + t)) - Σ λ F over the cell.
class Lagrangian {
  public:
    Lagrangian(const SearchGoal& goal, const Box& cell, const Vec3& at, std::span<LocalCondition> conditions)
        : goal_(goal), at_(at), lo_(cell.lo - at), hi_(cell.hi - at), conditions_(conditions) {}

    const Vec3& low() const { return lo_; }
    const Vec3& high() const { return hi_; }

    void minimise() {
        const Vec3 slope = goal_.along ? -goal_.place : at_ - goal_.place;
        const double bend = goal_.along ? 0 : 1;
        for (int axis = 0; axis < 3; ++axis) {
            double a = bend, b = slope[axis];
            for (const LocalCondition& c : conditions_) {
                a -= c.multiplier * c.upper[axis];
                b -= c.multiplier * c.gradient[axis];
            }
            t_[axis] = minimiser(a, b, lo_[axis], hi_[axis]);
        }
    }

    double value_of(const LocalCondition& c) const {
        double sum = c.value;
        for (int axis = 0; axis < 3; ++axis)
            sum += (0.5 * c.upper[axis] * t_[axis] + c.gradient[axis]) * t_[axis];
        return sum;
    }

    // The multiplier at which the condition just holds at the minimiser; zero if it holds without one.
    void improve(LocalCondition& c) {
        const double before = c.multiplier;
        c.multiplier = 0;
        minimise();
        double low = 0, low_value = value_of(c);
        if (low_value >= 0) return;
        const double steep = norm(c.gradient);
        double high = before > 0 ? before : (goal_.along ? 1.0 : norm(point() - goal_.place) + 1e-9) / steep;
        if (!(high < std::numeric_limits<double>::infinity())) high = 1;
        double high_value = low_value;
        for (int i = 0; i < kDoublings; ++i, high *= 2) {
            c.multiplier = high;
            minimise();
            high_value = value_of(c);
            if (high_value >= 0) break;
            low = high, low_value = high_value;
        }
        if (high_value >= 0) narrow(c, low, low_value, high, high_value);
    }

    double cost() const {
        double sum = 0;
        for (const LocalCondition& c : conditions_) {
            if (c.multiplier > 0) sum += c.multiplier * value_of(c);
        }
        const double own = goal_.cost(point());
        if (goal_.along) return own - sum;
        return std::sqrt(std::max(own * own - 2 * sum, 0.0));
    }

    Vec3 point() const { return at_ + t_; }

  private:
    // Regula falsi (Illinois).
    void narrow(LocalCondition& c, double low, double low_value, double high, double high_value) {
        int side = 0;
        for (int step = 0; step < kSteps && high_value != 0; ++step) {
            double middle = low - low_value * ((high - low) / (high_value - low_value));
            if (!(middle > low && middle < high)) break;
            c.multiplier = middle;
            minimise();
            const double value = value_of(c);
            if (value == 0) return;
            if (value < 0) {
                low = middle, low_value = value;
                if (side < 0) high_value *= 0.5;
                side = -1;
            } else {
                high = middle, high_value = value;
                if (side > 0) low_value *= 0.5;
                side = 1;
            }
            if (high - low < 1e-14 * high) break;
        }
        c.multiplier = high;
        minimise();
    }

    const SearchGoal& goal_;
    Vec3 at_, lo_, hi_, t_;
    std::span<LocalCondition> conditions_;
};

}  // namespace

Vec3 SearchGoal::best_of(const Box& box) const {
    if (!along) return max(box.lo, min(place, box.hi));
    Vec3 corner;
    for (int axis = 0; axis < 3; ++axis) corner[axis] = place[axis] > 0 ? box.hi[axis] : box.lo[axis];
    return corner;
}

LocalCondition local_condition(const Expansion& e, bool positive) {
    if (positive) return {e.value, e.gradient, e.upper, 0};
    return {-e.value, -e.gradient, -e.lower, 0};
}

RegionBound bound_region(const SearchGoal& goal, const Box& cell, const Vec3& at,
                         std::span<LocalCondition> conditions) {
    Lagrangian lagrangian(goal, cell, at, conditions);
    for (const LocalCondition& c : conditions) {
        if (greatest(c, lagrangian.low(), lagrangian.high()) < 0)
            return {std::numeric_limits<double>::infinity(), at};
    }
    const int rounds = conditions.size() > 1 ? kRounds : 1;
    for (int round = 0; round < rounds; ++round) {
        for (LocalCondition& c : conditions) lagrangian.improve(c);
    }
    lagrangian.minimise();
    return {lagrangian.cost(), lagrangian.point()};
}

}  // namespace pfgeom
