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

Tangent tangent_of(const Jet& jet, double error, const Vec3& half) {
    const Vec3& g = jet.gradient;
    const double reach = std::abs(g.x) * half.x + std::abs(g.y) * half.y + std::abs(g.z) * half.z;
    const double slack = 1e-12 * (std::abs(jet.value) + reach + error);
    return {jet.value, g, error + slack};
}

PrunedFunction::PrunedFunction(const FunctionField& whole, const Box& box)
    : whole_(whole), box_(box), bend_(largest_bend(whole.base())) {
    for (const Perturbation& r : whole.perturbations())
        if (cell_range(in_frame_of(r.quadric, box)).hi > 0) perturbations_.push_back(r);
    for (std::size_t i = 0; i < whole.level_count(); ++i) add(whole.level(i));
    balls_.shrink_to_fit();
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
    // Along a line, (1-|x|²/r²)³ has second derivatives of at most 6 / r² and third ones of at most 48 / r³.
    bend_ += 6 * level.inverse_squared() * (sum.hi - sum.lo);
    twist_ += 48 * level.inverse_squared() / radius * (sum.hi - sum.lo);
    parts_.push_back({level.inverse_squared(), balls_.size()});
}

double PrunedFunction::value(const Vec3& p) const {
    return box_.contains(p) ? values_of(p, p)[0] : whole_.value(p);
}

double PrunedFunction::value_and_gradient(const Vec3& p, Vec3& gradient) const {
    if (!box_.contains(p)) return whole_.value_and_gradient(p, gradient);
    const Jet jet = jets_of(p, p)[0];
    gradient = jet.gradient;
    return jet.value;
}

void PrunedFunction::values(std::span<const Vec3> points, std::span<double> values) const {
    for (std::size_t i = 0; i < points.size(); i += 2) {
        const std::size_t j = std::min(i + 1, points.size() - 1);
        const bool inside = box_.contains(points[i]) && box_.contains(points[j]);
        const std::array both =
            inside ? values_of(points[i], points[j]) : std::array{value(points[i]), value(points[j])};
        values[i] = both[0];
        values[j] = both[1];
    }
}

void PrunedFunction::values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                                          std::span<Vec3> gradients) const {
    for (std::size_t i = 0; i < points.size(); i += 2) {
        const std::size_t j = std::min(i + 1, points.size() - 1);
        if (!box_.contains(points[i]) || !box_.contains(points[j])) {
            for (const std::size_t k : {i, j}) values[k] = value_and_gradient(points[k], gradients[k]);
            continue;
        }
        const auto [a, b] = jets_of(points[i], points[j]);
        values[i] = a.value;
        values[j] = b.value;
        gradients[i] = a.gradient;
        gradients[j] = b.gradient;
    }
}

double PrunedFunction::smooth_value(const Vec3& p) const {
    double sum = whole_.base().value(p);
    for (const Perturbation& r : perturbations_) {
        const double q = r.quadric.value(p);
        if (q > 0) sum += r.factor * (q * q * q);
    }
    return sum;
}

Jet PrunedFunction::smooth_jet(const Vec3& p) const {
    Jet jet{whole_.base().value(p), whole_.base().gradient(p)};
    for (const Perturbation& r : perturbations_) {
        const double q = r.quadric.value(p);
        if (q <= 0) continue;
        jet.value += r.factor * (q * q * q);
        jet.gradient += (3 * r.factor * (q * q)) * r.quadric.gradient(p);
    }
    return jet;
}

// Balls that do not reach a point add a zero, so that there is nothing to foresee: of 60 balls in a loop of
// their own two points take 0.15 µs, with gradients 0.20; one after the other 0.48 and 0.56. Four or eight at
// a time are a tenth sooner yet, but points seldom come in such numbers.
std::array<double, 2> PrunedFunction::values_of(const Vec3& a, const Vec3& b) const {
    const Pair x{a.x, b.x}, y{a.y, b.y}, z{a.z, b.z};
    Pair sum{smooth_value(a), smooth_value(b)};
    const Ball* ball = balls_.data();
    for (const Part& part : parts_) {
        for (const Ball* end = balls_.data() + part.end; ball != end; ++ball) {
            const Pair dx = x - ball->centre.x, dy = y - ball->centre.y, dz = z - ball->centre.z;
            const Pair q = positive(1.0 - ((dx * dx + dy * dy) + dz * dz) * part.inverse_squared);
            sum += ball->factor * (q * q * q);
        }
    }
    return {sum[0], sum[1]};
}

std::array<Jet, 2> PrunedFunction::jets_of(const Vec3& a, const Vec3& b) const {
    const Pair x{a.x, b.x}, y{a.y, b.y}, z{a.z, b.z};
    const Jet ja = smooth_jet(a), jb = smooth_jet(b);
    Pair sum{ja.value, jb.value};
    Pair gx{ja.gradient.x, jb.gradient.x}, gy{ja.gradient.y, jb.gradient.y}, gz{ja.gradient.z, jb.gradient.z};
    const Ball* ball = balls_.data();
    for (const Part& part : parts_) {
        const double steepness = -6 * part.inverse_squared;
        for (const Ball* end = balls_.data() + part.end; ball != end; ++ball) {
            const Pair dx = x - ball->centre.x, dy = y - ball->centre.y, dz = z - ball->centre.z;
            const Pair q = positive(1.0 - ((dx * dx + dy * dy) + dz * dz) * part.inverse_squared);
            const Pair fq2 = ball->factor * (q * q), slope = steepness * fq2;
            sum += fq2 * q;
            gx += slope * dx;
            gy += slope * dy;
            gz += slope * dz;
        }
    }
    return {Jet{sum[0], {gx[0], gy[0], gz[0]}}, Jet{sum[1], {gx[1], gy[1], gz[1]}}};
}

}  // namespace pfgeom
