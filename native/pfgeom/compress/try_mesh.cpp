#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/fit/collapse_estimate.h"
#include "pfgeom/fit/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

Outcome attempt(const Goal& goal, double share, const Task& task) {
    Outcome outcome;
    outcome.candidate = "mesh";
    outcome.object = fit_mesh_part(goal.mesh, {goal.tolerance, goal.metric, share}, task);
    auto& part = std::get<MeshPart>(outcome.object.shape);
    part = canonical(part);
    prove(goal, outcome, task);
    return outcome;
}

// The simplifier's own measure of the rms is off by up to a fifth either way (rocker-arm at 5e-4), but by the
// same factor at neighbouring shares: so it is corrected by what was measured.
std::optional<Outcome> search_rms(const Goal& goal, const Task& task) {
    constexpr int kMostAttempts = 4;
    constexpr double kAim = 0.98, kBand = 0.025;
    std::optional<Outcome> best;
    double share = 1;
    for (int i = 0; i < kMostAttempts; ++i) {
        const Outcome outcome = attempt(goal, share, task);
        const double reached = outcome.deviation.rms() / goal.tolerance;
        if (outcome.holds && (!best || outcome.bytes < best->bytes)) best = outcome;
        if (!(reached > 0) || (outcome.holds && reached > kAim - kBand)) break;
        share *= std::clamp(kAim / reached, 0.5, 1.5);
    }
    return best;
}

}  // namespace

// Measured: at a maximum of 1e-3 of the diagonal, on eight closed islands with 200 to 1,900 vertices in the
// end, plane quadrics alone leave 0.54 to 0.99 times as many at the tolerance over √2, 0.9 to 1.5 times at
// half of it; for the rms, on three, 0.6 to 0.93 times at four times the tolerance, 1.2 to 2.3 times at
// twice. The coded mesh has 3.5 to 6.5 bytes for each of the former where a tree can serve, 2.1 to 2.7 on
// free forms.
MeshEstimate estimate_mesh(const Goal& goal, const Task& task) {
    constexpr double kLeastBytes = 2.6, kMostBytes = 3.5;
    const bool by_max = goal.metric == Metric::max;
    const std::array limits{goal.tolerance * (by_max ? 0.5 : 2),
                            goal.tolerance * (by_max ? std::sqrt(0.5) : 4)};
    const std::vector<std::size_t> left = vertices_after_collapses(goal.mesh, limits, task);
    return {static_cast<std::size_t>(kLeastBytes * static_cast<double>(left[1])),
            static_cast<std::size_t>(kMostBytes * static_cast<double>(left[0]))};
}

Outcome try_mesh(const Goal& goal, const Task& task) {
    if (goal.metric == Metric::rms) {
        if (std::optional<Outcome> found = search_rms(goal, task)) return *std::move(found);
        return attempt(goal, 0, task);
    }
    Outcome outcome;
    for (const double share : {1.0, 0.95, 0.85, 0.7, 0.5, 0.0}) {
        outcome = attempt(goal, share, task);
        if (outcome.holds) break;
    }
    return outcome;
}

}  // namespace pfgeom
