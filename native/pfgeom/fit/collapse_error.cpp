#include "pfgeom/fit/collapse_error.h"

#include "pfgeom/fit/symmetric3.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfgeom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Where no more than this many tolerances can come out, the search for the largest distance ends.
constexpr double kHarmless = 0.8;

// Barycentric weight of corner 0 at a point q of the triangle.
double weight_of_corner(const std::array<Vec3, 3>& t, const Vec3& q) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double area = squared_norm(normal);
    return area > 0 ? std::clamp(dot(cross(t[1] - q, t[2] - q), normal) / area, 0.0, 1.0) : 0;
}

// Points of a new face, of a curved one by their weights; and whether a part of it is within a distance of a
// triangle. A part of a curved one lies within the hull of its Bézier points.
using Corners = std::array<Vec3, 3>;
struct CurvedFace {
    CurvedTriangle face;
    Vec3 operator()(const Vec3& weights) const { return face.at(weights); }
    bool within(double distance, const Corners& part, const Bvh& bvh, std::int32_t other) const {
        const auto& [a, b, c] = part;
        const Vec3 pa = face.at(a), pb = face.at(b), pc = face.at(c);
        if (bvh.farthest_corner({pa, pb, pc}, other) > distance) return false;
        const Corners sides{(pa + pb - face.bend(a - b)) * 0.5, (pb + pc - face.bend(b - c)) * 0.5,
                            (pc + pa - face.bend(c - a)) * 0.5};
        return bvh.farthest_corner(sides, other) <= distance;
    }
};
struct FlatFace {
    Vec3 operator()(const Vec3& p) const { return p; }
    bool within(double distance, const Corners& part, const Bvh& bvh, std::int32_t other) const {
        return bvh.farthest_corner(part, other) <= distance;
    }
};

}  // namespace

CollapseError::CollapseError(const TriangleMesh& original, Metric metric, double tolerance, double spacing,
                             const Task& task)
    : metric_(metric),
      tolerance_(tolerance),
      spacing_(spacing),
      bvh_(original, task),
      samples_(original, spacing) {}

void CollapseError::start_from(const TriangleMesh& part, const Task& task) {
    sum_ += samples_.start_from(part, task);
}

double CollapseError::forward(const Patch& patch, double limit) const {
    const bool by_max = metric_ == Metric::max;
    const double cap = by_max ? limit * limit : kInfinity;
    double cost = 0;
    const NearestFace nearest(patch, tolerance_);
    const auto enough = [&] { return by_max ? cost : measured_out(); };
    const auto add_sample = [&](const FaceSample& sample, const NearestFace::Found& found) {
        if (by_max)
            cost = std::max(cost, found.squared);
        else
            cost += sample.weight * (found.squared - sample.squared);
        return found.squared <= cap;
    };
    for (const std::int32_t f : patch.before) {
        if (!visit_samples(nearest, f, enough, add_sample) || (!by_max && cost > limit)) return kInfinity;
    }
    return by_max ? std::sqrt(cost) : cost;
}

// The moving vertex and its edges: they stick out furthest. Where only one triangle of the patch has an edge
// nothing else holds the surface back, and it is looked at closely.
double CollapseError::rims(const Patch& patch, double limit, double enough) const {
    double worst = 0;
    for (std::size_t row = 0; row < patch.triangles.size(); ++row) {
        for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
            const Vec3 &p = patch.triangles[row][0], &q = patch.triangles[row][k];
            const auto uses = [&](const std::array<Vec3, 3>& t) { return t[1] == q || t[2] == q; };
            const bool rim = std::count_if(patch.triangles.begin(), patch.triangles.end(), uses) == 1;
            if (!rim && k == 2) continue;  // another triangle's first edge
            const double close = std::ceil(norm(q - p) / (rim ? tolerance_ : 2 * tolerance_));
            const int n = static_cast<int>(std::min(close, rim ? 100.0 : 40.0));
            std::int32_t hint = -1;
            for (int i = 0; i < n; ++i) {
                const double along = static_cast<double>(i) / n;
                Vec3 at = p + (q - p) * along;
                if (patch.curved()) at += patch.bulges[row][k == 1 ? 0 : 2] * (4 * along * (1 - along));
                const ClosestPoint found = bvh_.closest(at, limit, hint, enough);
                if (found.face < 0) return kInfinity;
                worst = std::max(worst, found.squared_distance);
                hint = found.face;
            }
        }
    }
    return std::sqrt(worst);
}

// Distances are 1-Lipschitz, which would make this a proof at many times the cost; over most of a surface
// they change far more slowly, as closeness_ has it. `surface` makes points of parameters.
template <class Surface>
double CollapseError::farthest(const std::array<Vec3, 3>& corners, const Surface& surface, double finest,
                               double limit, double enough, std::int32_t hint) const {
    const double harmless = kHarmless * tolerance_;
    double worst = 0;
    std::vector<std::array<Vec3, 3>> parts_left{corners};
    while (!parts_left.empty()) {
        const auto [a, b, c] = parts_left.back();
        parts_left.pop_back();
        const Vec3 middle = surface((a + b + c) / 3);
        const double reach =
            std::sqrt(std::max({squared_norm(surface(a) - middle), squared_norm(surface(b) - middle),
                                squared_norm(surface(c) - middle)}));
        const double rise = reach < finest ? 0 : closeness_.slope * reach;
        const ClosestPoint found = bvh_.closest(middle, limit, hint, std::min(enough, harmless - rise));
        if (found.face < 0) return kInfinity;
        hint = found.face;
        const double distance = std::sqrt(found.squared_distance);
        worst = std::max(worst, distance);
        const double most = std::max(worst, harmless);
        if (distance + rise <= most) continue;
        if (surface.within(std::max(most, enough), {a, b, c}, bvh_, found.face)) continue;
        const Vec3 ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
        parts_left.insert(parts_left.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return worst;
}

double CollapseError::backward(const Patch& patch, double limit, double enough) const {
    double worst = rims(patch, limit, enough);
    for (std::size_t row = 0; row < patch.triangles.size() && worst <= limit; ++row) {
        const std::vector<FaceSample>& samples = samples_.of(patch.after[row]);
        const std::int32_t hint = samples.empty() ? -1 : samples.back().origin;
        const std::array<Vec3, 3>& t = patch.triangles[row];
        const double longest = std::sqrt(longest_squared(t));
        if (patch.curved()) {
            const CurvedFace at{patch.surface(row)};
            const double finest =
                std::max(closeness_.finest * tolerance_, longest / (kCurvedParts * closeness_.parts));
            worst = std::max(worst,
                             farthest({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, at, finest, limit, enough, hint));
        } else {
            const double finest = std::max(closeness_.finest * tolerance_, longest / closeness_.parts);
            worst = std::max(worst, farthest(t, FlatFace{}, finest, limit, enough, hint));
        }
    }
    return worst <= limit ? worst : kInfinity;
}

// Minimises Σ w (d - λ e·δ)² over the move δ of the vertex: d is a sample's distance, e its direction, λ the
// vertex's barycentric weight at the closest point. For the maximum the weights are d² (a fourth power norm).
Vec3 CollapseError::fitted(const Patch& patch) const {
    Symmetric3 system;
    Vec3 right;
    double trace = 0;
    visit_samples(patch, [&](const FaceSample& sample, const auto& found) {
        const auto& t = patch.triangles[found.row];
        const double lambda = weight_of_corner(t, found.point), d = std::sqrt(found.squared);
        const Vec3 normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
        Vec3 direction = d > 1e-9 * spacing_ ? (sample.p - found.point) / d : normal;
        if (patch.fixed_axis != Patch::kNoAxis) direction[patch.fixed_axis] = 0;
        const double weight = metric_ == Metric::max ? found.squared : sample.weight;
        system.add(direction * lambda, weight);
        right += direction * (lambda * d * weight);
        trace += lambda * lambda * weight;
    });
    system.add_diagonal(0.02 * trace);
    return patch.triangles[0][0] + system.solve(right);
}

void CollapseError::commit(const Patch& patch) {
    struct Moved {
        FaceSample sample;
        std::int32_t face;
    };
    std::vector<Moved> moved;
    visit_samples(patch, [&](const FaceSample& sample, const auto& found) {
        if (metric_ == Metric::rms) sum_ += sample.weight * (found.squared - sample.squared);
        moved.push_back({sample, patch.after[found.row]});
        moved.back().sample.squared = found.squared;
    });
    for (const std::int32_t f : patch.before) samples_.clear(f);
    for (const Moved& m : moved) samples_.put(m.face, m.sample);
}

}  // namespace pfgeom
