#include "pfgeom/fit/collapse_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pfgeom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A proposal whose error is above this share of the limit is fitted to the samples.
constexpr double kWorthFitting = 0.3;
// A proposal this much over the limit is fitted too; beyond, fitting does not save it.
constexpr double kMayBeSaved = 3;
// Share of the limit that a collapse may take, by its quadrics alone, to be done without a look at distances.
// Not at borders, whose planes count little in the mean beside a flat side (the holes below the bunny).
constexpr double kHarmless = 0.1;
// ... and how far the vertex may be from each plane: in the mean a narrow wall beside a large flat side
// counts for nothing (foot of thingi-58011 at 2e-4: 1.6 tolerances off, the flat beetle-alt at 1e-3 2.9).
constexpr double kHarmlessStep = 0.5;

}  // namespace

// What a single collapse may cost.
double CollapseCost::limit() const {
    if (limits_.metric == Metric::max) return limits_.forward;
    return (limits_.forward * limits_.forward - error_.mean_square()) * error_.total_weight();
}

double CollapseCost::of_length(std::int32_t u, std::int32_t v) const {
    const double share = 0.02 * norm(mesh_.point(u) - mesh_.point(v)) / limits_.size;
    if (limits_.metric == Metric::max) return share * limits_.forward;
    return 1e-7 * share * limits_.forward * limits_.forward * error_.total_weight();
}

PlaneQuadric CollapseCost::quadric(std::int32_t u, std::int32_t v) const {
    PlaneQuadric q = quadrics_[static_cast<std::size_t>(u)];
    q += quadrics_[static_cast<std::size_t>(v)];
    return q;
}

Vec3 CollapseCost::place_of(const PlaneQuadric& q, std::int32_t u, std::int32_t v) const {
    const Vec3 &p = mesh_.point(u), &r = mesh_.point(v);
    if (limits_.keep_places) return q(p) < q(r) ? p : r;
    return q.least((p + r) * 0.5);
}

CollapseEntry CollapseCost::estimate(std::int32_t u, std::int32_t v, std::uint32_t clock) const {
    const PlaneQuadric q = quadric(u, v);
    const Vec3 place = place_of(q, u, v);
    const double rest = q(place), rms = std::sqrt(rest / std::max(q.weight, 1e-300));
    // Both in the unit of forward(): the quadrics' weights are doubled areas, counted at three corners.
    const double cost = limits_.metric == Metric::max ? rms : rest / 6;
    const bool harmless =
        rms <= kHarmless * limits_.forward && !error_.quantised() && !on_border(u) && !on_border(v);
    return {cost + of_length(u, v), u, v, clock, false, harmless, place};
}

bool CollapseCost::is_harmless(const Patch& patch) const {
    const Vec3& place = patch.triangles[0][0];
    const double most = kHarmlessStep * limits_.forward;
    return std::all_of(patch.before.begin(), patch.before.end(), [&](std::int32_t f) {
        const auto [a, b, c] = mesh_.corners(f);
        return std::abs(dot(normalized(cross(b - a, c - a)), place - a)) <= most;
    });
}

double CollapseCost::cost_of(const Patch& patch, double most) const {
    return mesh_.keeps_orientation(patch) ? error_.forward(patch, most) : kInfinity;
}

MeasuredCollapse CollapseCost::measure(std::int32_t u, std::int32_t v) const {
    const double most = limit();
    const Vec3 place = error_.placed(place_of(quadric(u, v), u, v));
    MeasuredCollapse best;
    mesh_.patch_of_collapse(u, v, place, best.patch);
    if (best.patch.curved()) error_.bend(best.patch);
    best.cost = cost_of(best.patch, kMayBeSaved * most);
    if (limits_.keep_places) {
        if (best.cost > most) {
            best.patch.move_to(place == mesh_.point(u) ? mesh_.point(v) : mesh_.point(u));
            best.cost = cost_of(best.patch, most);
        }
    } else if (best.cost > kWorthFitting * most && best.cost < kInfinity) {
        Patch fitted = best.patch;
        if (fitted.curved())
            error_.refit(fitted, true);
        else
            fitted.move_to(error_.fitted(fitted));
        const double better = cost_of(fitted, std::min(best.cost, most));
        if (better < best.cost) best = {std::move(fitted), better, {}};
    }
    if (best.cost > most) best.cost = kInfinity;
    return best;
}

}  // namespace pfgeom
