#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/fit/simplify.h"

#include <algorithm>

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

Outcome try_mesh(const Goal& goal, const Task& task) {
    if (goal.metric == Metric::rms) {
        if (std::optional<Outcome> found = search_rms(goal, task)) return *std::move(found);
        return attempt(goal, 0, task);
    }
    Outcome outcome;
    for (const double share : {1.0, 0.95, 0.85, 0.6, 0.0}) {
        outcome = attempt(goal, share, task);
        if (outcome.holds) break;
    }
    return outcome;
}

}  // namespace pfgeom
