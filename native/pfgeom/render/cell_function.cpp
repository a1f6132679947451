#include "pfgeom/render/cell_function.h"

#include "pfgeom/eval/cell_quadric.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// A bound of the norm of a quadric's Hessian: Frobenius.
double hessian_norm(const Quadric& q) {
    const auto& c = q.c;
    return std::sqrt(4 * (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]) +
                     2 * (c[3] * c[3] + c[4] * c[4] + c[5] * c[5]));
}

double cubed(double x) {
    return x * x * x;
}

// max(x, 0), exactly, in a form that no compiler makes a branch of.
double positive_part(double x) {
    return 0.5 * (x + std::abs(x));
}

// F in a box, from Taylor's theorem around the centre. A term enters by its value, gradient and bend, or,
// where that is sharper (perturbations that are small in the box), by the range of its values.
class CellSum {
  public:
    CellSum(const Quadric& base, const Box& box)
        : box_(box),
          centre_(box.centre()),
          half_(max(box.hi - centre_, centre_ - box.lo)),
          squared_reach_(squared_norm(half_)) {
        add_jet({base.value(centre_), base.gradient(centre_)}, hessian_norm(base));
    }

    // False: zero throughout the box.
    bool add(const FunctionTerms::Ball& ball) {
        const double a = ball.inverse_squared, f = ball.factor, strength = 6 * a * std::abs(f);
        const double most = 1 - box_.squared_distance(ball.centre) * a;
        if (most <= -kSlack) return false;
        const Vec3 d = centre_ - ball.centre;
        const Vec3 far{std::abs(d.x) + half_.x, std::abs(d.y) + half_.y, std::abs(d.z) + half_.z};
        // The Hessian's eigenvalues are -6 a f q² and 6 a f q (4 - 5 q): the latter is largest at q = 0.4.
        const double q = std::clamp(most, 0.0, 1.0), steep = q < 0.4 ? q * (4 - 5 * q) : 0.8;
        const double bend = strength * std::max(q * q, steep);
        const Interval range{std::max(1 - squared_norm(far) * a, 0.0), q};
        const double at = std::max(1 - squared_norm(d) * a, 0.0);
        const Jet jet{f * cubed(at), (-6 * a * f * (at * at)) * d};
        add_term(jet, bend, f, range);
        return true;
    }

    bool add(const Perturbation& p) {
        const Interval q = cell_range(in_frame_of(p.quadric, box_));
        if (q.hi <= 0) return false;
        const double f = p.factor, hessian = hessian_norm(p.quadric);
        const Vec3 g = p.quadric.gradient(centre_);
        const double slope = norm(g) + hessian * std::sqrt(squared_reach_);
        // The Hessian of f q³ is 6 f q ∇q ∇qᵀ + 3 f q² H.
        const double bend = std::abs(f) * (6 * q.hi * slope * slope + 3 * q.hi * q.hi * hessian);
        const double at = std::max(p.quadric.value(centre_), 0.0);
        add_term({f * cubed(at), (3 * f * (at * at)) * g}, bend, f, {std::max(q.lo, 0.0), q.hi});
        return true;
    }

    void write(CellFunction& cell) const {
        const Vec3& g = jet_.gradient;
        const double rise = std::abs(g.x) * half_.x + std::abs(g.y) * half_.y + std::abs(g.z) * half_.z;
        const double error = 0.5 * bend_ * squared_reach_ + spread_;
        cell.centre = centre_;
        cell.linear = jet_;
        cell.error = error + kSlack * (std::abs(jet_.value) + rise + error + size_);
        cell.range = {jet_.value - rise - cell.error, jet_.value + rise + cell.error};
        cell.bend = whole_bend_;
        cell.added_bend = added_bend_;
    }

  private:
    static constexpr double kSlack = 1e-12;  // rounding of some hundred terms

    void add_jet(const Jet& jet, double bend) {
        jet_.value += jet.value;
        jet_.gradient += jet.gradient;
        size_ += std::abs(jet.value);
        bend_ += bend;
        whole_bend_ += bend;
    }

    void add_term(const Jet& jet, double bend, double factor, const Interval& q) {
        added_bend_ += bend;
        const double low = cubed(q.lo), high = cubed(q.hi), spread = 0.5 * std::abs(factor) * (high - low);
        if (0.5 * bend * squared_reach_ < spread) {
            add_jet(jet, bend);
            return;
        }
        jet_.value += 0.5 * factor * (low + high);
        size_ += std::abs(factor) * high;
        spread_ += spread;
        whole_bend_ += bend;
    }

    Box box_;
    Vec3 centre_, half_;
    double squared_reach_;
    Jet jet_;
    double bend_ = 0, spread_ = 0, size_ = 0, whole_bend_ = 0, added_bend_ = 0;
};

}  // namespace

FunctionTerms::FunctionTerms(const Function& function)
    : base_(function.base), perturbations_(function.perturbations) {
    for (const Level& level : function.levels) {
        const double inverse_squared = 1 / (level.radius * level.radius);
        for (std::size_t i = 0; i < level.z.size(); ++i) {
            if (level.z[i] != 0) balls_.push_back({level.centres[i], inverse_squared, level.factor(i)});
        }
    }
}

// Without a branch a ball: a term that is zero changes nothing, and which ones are is hard to foresee.
// (Igea is drawn in 1.33 s of CPU time instead of 1.43.)
double FunctionTerms::value(const Vec3& p, std::span<const std::int32_t> live) const {
    double sum = base_.value(p);
    std::size_t at = 0;
    for (; at < live.size() && static_cast<std::size_t>(live[at]) < perturbations_.size(); ++at) {
        const Perturbation& r = perturbations_[static_cast<std::size_t>(live[at])];
        const double q = positive_part(r.quadric.value(p));
        sum += r.factor * (q * q * q);
    }
    for (; at < live.size(); ++at) {
        const Ball& b = ball(static_cast<std::size_t>(live[at]));
        const double q = positive_part(1 - squared_norm(p - b.centre) * b.inverse_squared);
        sum += b.factor * (q * q * q);
    }
    return sum;
}

Jet FunctionTerms::jet(const Vec3& p, std::span<const std::int32_t> live) const {
    Jet jet{base_.value(p), base_.gradient(p)};
    for (const std::int32_t i : live) {
        const auto term = static_cast<std::size_t>(i);
        if (term < perturbations_.size()) {
            const Perturbation& r = perturbations_[term];
            const double q = r.quadric.value(p);
            if (q <= 0) continue;
            jet.value += r.factor * (q * q * q);
            jet.gradient += (3 * r.factor * (q * q)) * r.quadric.gradient(p);
        } else {
            const Ball& b = ball(term);
            const Vec3 d = p - b.centre;
            const double q = 1 - squared_norm(d) * b.inverse_squared;
            if (q <= 0) continue;
            const double fq2 = b.factor * (q * q);
            jet.value += fq2 * q;
            jet.gradient += (-6 * b.inverse_squared * fq2) * d;
        }
    }
    return jet;
}

CellFunction look_at_cell(const FunctionTerms& terms, std::span<const std::int32_t> live, const Box& box) {
    CellFunction cell;
    CellSum sum(terms.base(), box);
    for (const std::int32_t i : live) {
        const auto term = static_cast<std::size_t>(i);
        const bool alive =
            term < terms.perturbation_count() ? sum.add(terms.perturbation(term)) : sum.add(terms.ball(term));
        if (alive) cell.live.push_back(i);
    }
    sum.write(cell);
    return cell;
}

}  // namespace pfgeom
