#include "pfgeom/eval/function_field.h"

#include "pfgeom/eval/pruned_function.h"

namespace pfgeom {
namespace {

std::vector<Vec3> centres_of_nonzero(const Level& level) {
    std::vector<Vec3> centres;
    for (std::size_t i = 0; i < level.z.size(); ++i) {
        if (level.z[i] != 0) centres.push_back(level.centres[i]);
    }
    return centres;
}

}  // namespace

LevelField::LevelField(const Level& level)
    : grid_(centres_of_nonzero(level), level.radius), inverse_squared_(1 / (level.radius * level.radius)) {
    for (std::size_t i = 0; i < level.z.size(); ++i) {
        if (level.z[i] != 0) factors_.push_back(level.factor(i));
    }
    bounds_ = SumBounds(grid_, factors_);
}

FunctionField::FunctionField(const Function& function) : base_(function.base) {
    for (const Perturbation& p : function.perturbations) add(p);
    for (const Level& level : function.levels) add(level);
}

double FunctionField::value(const Vec3& p) const {
    double sum = base_.value(p);
    for (const Perturbation& r : perturbations_) {
        const double q = r.quadric.value(p);
        if (q > 0) sum += r.factor * (q * q * q);
    }
    for (const LevelField& level : levels_) level.add_value(p, sum);
    return sum;
}

Jet FunctionField::jet(const Vec3& p) const {
    Jet jet{base_.value(p), base_.gradient(p)};
    for (const Perturbation& r : perturbations_) {
        const double q = r.quadric.value(p);
        if (q <= 0) continue;
        jet.value += r.factor * (q * q * q);
        jet.gradient += (3 * r.factor * (q * q)) * r.quadric.gradient(p);
    }
    for (const LevelField& level : levels_) level.add_jet(p, jet);
    return jet;
}

double FunctionField::value_and_gradient(const Vec3& p, Vec3& gradient) const {
    const Jet j = jet(p);
    gradient = j.gradient;
    return j.value;
}

Interval FunctionField::range(const Box& box) const {
    return tangent(box).over({}, box.extent() * 0.5);
}

// The coarse part of F (base and levels whose balls are larger than the box) by Taylor's theorem around the
// centre, the fine part by the bounds of its sums. The Hessian of (1-|x|²/r²)³ has a norm of at most 6 / r².
Tangent FunctionField::tangent(const Box& box) const {
    const Vec3 c = box.centre(), half = box.extent() * 0.5;
    const double width = 2 * std::max({half.x, half.y, half.z});
    Jet coarse{base_.value(c), base_.gradient(c)};
    double bend = largest_bend(base_);
    Interval fine = sum_over(perturbations_, box);
    for (const LevelField& level : levels_) {
        const Interval sum = level.bounds().over(box);
        if (level.radius() > width) {
            level.add_jet(c, coarse);
            bend += 6 * level.inverse_squared() * (sum.hi - sum.lo);
        } else {
            fine.lo += sum.lo;
            fine.hi += sum.hi;
        }
    }
    coarse.value += (fine.lo + fine.hi) / 2;
    return tangent_of(coarse, 0.5 * bend * squared_norm(half) + (fine.hi - fine.lo) / 2, half);
}

std::unique_ptr<const ScalarField> FunctionField::pruned(const Box& box) const {
    return std::make_unique<PrunedFunction>(*this, box);
}

double FunctionField::curvature(const Vec3& p) const {
    // Hessian of f q³, with a = 1/r²: 24 a² f q d dᵀ - 6 a f q² I; of the base: constant.
    const auto& c = base_.c;
    Vec3 diagonal{2 * c[0], 2 * c[1], 2 * c[2]};
    Vec3 mixed{c[3], c[4], c[5]};  // xy, xz, yz
    Vec3 g = base_.gradient(p);
    for (const LevelField& level : levels_) {
        const double a = level.inverse_squared();
        level.grid().near(p, [&](std::int32_t ball, double q, const Vec3& d) {
            const double f = level.factor(ball), e = -6 * a * f * (q * q), s = 24 * a * a * f * q;
            g += e * d;
            diagonal += Vec3{s * d.x * d.x + e, s * d.y * d.y + e, s * d.z * d.z + e};
            mixed += Vec3{s * d.x * d.y, s * d.x * d.z, s * d.y * d.z};
        });
    }
    const double length = std::max(norm(g), 0.1);
    const Vec3 n = g / length;
    const Vec3 hn{diagonal.x * n.x + mixed.x * n.y + mixed.y * n.z,
                  mixed.x * n.x + diagonal.y * n.y + mixed.z * n.z,
                  mixed.y * n.x + mixed.z * n.y + diagonal.z * n.z};
    return ((diagonal.x + diagonal.y + diagonal.z) - dot(n, hn)) / length;
}

}  // namespace pfgeom
