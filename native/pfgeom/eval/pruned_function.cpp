#include "pfgeom/eval/pruned_function.h"

#include "pfgeom/eval/cell_quadric.h"

#include <algorithm>

namespace pfgeom {

double largest_bend(const Quadric& q) {
    return 2 * (std::abs(q.c[0]) + std::abs(q.c[1]) + std::abs(q.c[2]) + std::abs(q.c[3]) + std::abs(q.c[4]) +
                std::abs(q.c[5]));
}

Interval sum_over(std::span<const Perturbation> perturbations, const Box& box) {
    Interval sum;
    for (const Perturbation& r : perturbations) {
        const Interval q = cell_range(in_frame_of(r.quadric, box));
        const double lo = std::max(q.lo, 0.0), hi = std::max(q.hi, 0.0);
        const double a = r.factor * (lo * lo * lo), b = r.factor * (hi * hi * hi);
        sum.lo += std::min(a, b);
        sum.hi += std::max(a, b);
    }
    return sum;
}

Tangent tangent_of(const Jet& smooth, double bend, const Interval& other, const Vec3& half) {
    const Vec3& g = smooth.gradient;
    const double off = 0.5 * bend * squared_norm(half) + (other.hi - other.lo) / 2;
    const double reach = std::abs(g.x) * half.x + std::abs(g.y) * half.y + std::abs(g.z) * half.z;
    const double slack = 1e-12 * (std::abs(smooth.value) + reach + off);
    return {smooth.value + (other.lo + other.hi) / 2, g, off + slack};
}

PrunedFunction::PrunedFunction(const FunctionField& whole, const Box& box)
    : whole_(whole), box_(box), bend_(largest_bend(whole.base())) {
    for (const Perturbation& r : whole.perturbations())
        if (cell_range(in_frame_of(r.quadric, box)).hi > 0) perturbations_.push_back(r);
    for (std::size_t i = 0; i < whole.level_count(); ++i) add(whole.level(i));
}

// The grid's cells are as large as a ball's radius, and a ball stands in each that it meets.
void PrunedFunction::add(const LevelField& level) {
    constexpr double kRounding = 1 + 1e-9;
    const double radius = level.radius();
    const CellIndex lo = CellIndex::of(box_.lo, 1 / radius), hi = CellIndex::of(box_.hi, 1 / radius);
    std::vector<std::pair<std::int32_t, Vec3>> found;
    for (std::int32_t x = lo.x; x <= hi.x; ++x)
        for (std::int32_t y = lo.y; y <= hi.y; ++y)
            for (std::int32_t z = lo.z; z <= hi.z; ++z)
                for (const BallGrid::Entry& e : level.grid().list(level.grid().find({x, y, z})))
                    if (box_.squared_distance(e.centre) < kRounding * radius * radius)
                        found.emplace_back(e.ball, e.centre);
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Interval sum;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i > 0 && found[i].first == found[i - 1].first) continue;
        const double factor = level.factor(found[i].first);
        balls_.push_back({found[i].second, factor});
        (factor < 0 ? sum.lo : sum.hi) += factor;
    }
    bend_ += 6 * level.inverse_squared() * (sum.hi - sum.lo);
    parts_.push_back({level.inverse_squared(), balls_.size()});
}

double PrunedFunction::value(const Vec3& p) const {
    if (!box_.contains(p)) return whole_.value(p);
    double sum = whole_.base().value(p);
    for (const Perturbation& r : perturbations_) {
        const double q = r.quadric.value(p);
        if (q > 0) sum += r.factor * (q * q * q);
    }
    const Ball* ball = balls_.data();
    for (const Part& part : parts_) {
        for (const Ball* end = balls_.data() + part.end; ball != end; ++ball) {
            const double q = 1 - squared_norm(p - ball->centre) * part.inverse_squared;
            if (q > 0) sum += ball->factor * (q * q * q);
        }
    }
    return sum;
}

double PrunedFunction::value_and_gradient(const Vec3& p, Vec3& gradient) const {
    if (!box_.contains(p)) return whole_.value_and_gradient(p, gradient);
    Jet jet{whole_.base().value(p), whole_.base().gradient(p)};
    for (const Perturbation& r : perturbations_) {
        const double q = r.quadric.value(p);
        if (q <= 0) continue;
        jet.value += r.factor * (q * q * q);
        jet.gradient += (3 * r.factor * (q * q)) * r.quadric.gradient(p);
    }
    const Ball* ball = balls_.data();
    for (const Part& part : parts_) {
        for (const Ball* end = balls_.data() + part.end; ball != end; ++ball) {
            const Vec3 d = p - ball->centre;
            const double q = 1 - squared_norm(d) * part.inverse_squared;
            if (q <= 0) continue;
            const double fq2 = ball->factor * (q * q);
            jet.value += fq2 * q;
            jet.gradient += (-6 * part.inverse_squared * fq2) * d;
        }
    }
    gradient = jet.gradient;
    return jet.value;
}

// Of boxes within the box: the balls are smooth everywhere, so Taylor's theorem serves for all of them.
Tangent PrunedFunction::tangent(const Box& box) const {
    const bool inside = box_.contains(box.lo) && box_.contains(box.hi);
    if (!inside || !perturbations_.empty()) return whole_.tangent(box);
    Jet jet;
    jet.value = value_and_gradient(box.centre(), jet.gradient);
    return tangent_of(jet, bend_, {}, box.extent() * 0.5);
}

}  // namespace pfgeom
