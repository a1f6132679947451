#include "pfgeom/base/error.h"
#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/fit/collapse_estimate.h"
#include "pfgeom/fit/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

// Of the tolerance: how far the default mesh may be from the curved faces, and how far where it would have
// more than so many times the input's triangles.
constexpr double kChordShare = 0.08, kMostChordShare = 0.5;
constexpr std::size_t kMostTriangles = 3;
// Larger meshes are not tried curved unless the effort is the best: it takes two to five times as long. Nor
// is the rms, whose searches for a share make that twenty.
constexpr std::size_t kMostCurved = 20'000;
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// The finest default mesh that is not too large for the input.
std::uint8_t mesh_code_of(const Goal& goal, const Object& object) {
    std::uint8_t code = mesh_code_for(goal, kChordShare * goal.tolerance);
    const std::uint8_t least = mesh_code_for(goal, kMostChordShare * goal.tolerance);
    const auto triangles = [&] {
        try {
            return mesh_of(object, {.chord = goal.diagonal * exp2_eighths(-2 * int{code})}).faces.size();
        } catch (const LimitExceeded&) {
            return kNoLimit;
        }
    };
    while (code > least && triangles() > kMostTriangles * goal.mesh.faces.size()) --code;
    return code;
}

Outcome attempt(const Goal& goal, double share, bool curved, const Task& task) {
    Outcome outcome;
    outcome.candidate = "mesh";
    const double chord = curved ? kChordShare * goal.tolerance : 0;
    outcome.object = fit_mesh_part(goal.mesh, {goal.tolerance - chord, goal.metric, share, curved}, task);
    if (curved) outcome.object.mesh_code = mesh_code_of(goal, outcome.object);
    auto& part = std::get<MeshPart>(outcome.object.shape);
    part = canonical(part);
    prove(goal, outcome, task);
    if (curved && outcome.mesh.faces.size() > kMostTriangles * goal.mesh.faces.size()) outcome.holds = false;
    return outcome;
}

// The simplifier's own measure of the rms is off by up to a fifth either way (rocker-arm at 5e-4), but by the
// same factor at neighbouring shares: so it is corrected by what was measured.
std::optional<Outcome> search_rms(const Goal& goal, bool curved, std::size_t most, const Task& task) {
    constexpr int kMostAttempts = 4;
    constexpr double kAim = 0.98, kBand = 0.025;
    std::optional<Outcome> best;
    double share = 1;
    for (int i = 0; i < kMostAttempts; ++i) {
        const Outcome outcome = attempt(goal, share, curved, task);
        const double reached = outcome.deviation.rms() / goal.tolerance;
        if (outcome.holds && (!best || outcome.bytes < best->bytes)) best = outcome;
        if (outcome.bytes >= most && reached >= kAim - kBand) break;
        if (!(reached > 0) || (outcome.holds && reached > kAim - kBand)) break;
        share *= std::clamp(kAim / reached, 0.5, 1.5);
    }
    return best;
}

Outcome try_flat(const Goal& goal, const Task& task) {
    if (goal.metric == Metric::rms) {
        if (std::optional<Outcome> found = search_rms(goal, false, kNoLimit, task)) return *std::move(found);
        return attempt(goal, 0, false, task);
    }
    Outcome outcome;
    for (const double share : {1.0, 0.95, 0.85, 0.7, 0.5, 0.0}) {
        outcome = attempt(goal, share, false, task);
        if (outcome.holds) break;
    }
    return outcome;
}

// With fewer bytes than `most`, or nothing.
std::optional<Outcome> try_curved(const Goal& goal, std::size_t most, const Task& task) {
    if (goal.metric == Metric::rms) {
        std::optional<Outcome> found = search_rms(goal, true, most, task);
        return found && found->bytes < most ? found : std::nullopt;
    }
    for (const double share : {1.0, 0.95, 0.88}) {
        Outcome outcome = attempt(goal, share, true, task);
        if (outcome.bytes >= most) break;
        if (outcome.holds) return outcome;
    }
    return {};
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
    Outcome flat = try_flat(goal, task);
    const bool quick = goal.metric == Metric::max && goal.mesh.faces.size() <= kMostCurved;
    if (goal.effort == Effort::fast || (goal.effort == Effort::normal && !quick)) return flat;
    std::optional<Outcome> curved = try_curved(goal, flat.bytes, task);
    return curved ? *std::move(curved) : flat;
}

}  // namespace pfgeom
