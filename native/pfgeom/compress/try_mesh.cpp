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

// Of the tolerance: how far the default mesh may be from the curved faces, how far where it would have more
// than three quarters of the input's triangles, or three times as many, and what the fit leaves for it.
constexpr double kChordShare = 0.08, kLongChordShare = 0.12, kMostChordShare = 0.5, kReserve = 0.08;
constexpr std::size_t kMostTriangles = 3;
// Inside a patch chords are off by more than along its edges: where the proof misses the tolerance by less
// than so much a finer default mesh is tried, with chords of half the length in the end.
constexpr double kMaySuffice = 1.15;
constexpr int kFinerCodes = 2, kMostFiner = 4;
// Larger meshes are not tried curved unless the effort is the best: igea (268,686 faces) takes 65 s flat and
// curved on two cores. Nor is the rms, whose searches for a share take three times as long.
constexpr std::size_t kMostCurved = 60'000;
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// The finest default mesh that is not too large for the input.
std::uint8_t mesh_code_of(const Goal& goal, const Object& object) {
    const auto code_for = [&](double share) { return mesh_code_for(goal, share * goal.tolerance); };
    std::uint8_t code = code_for(kChordShare);
    const auto triangles = [&] {
        try {
            return mesh_of(object, {.chord = goal.diagonal * exp2_eighths(-2 * int{code})}).faces.size();
        } catch (const LimitExceeded&) {
            return kNoLimit;
        }
    };
    std::size_t count = triangles();
    const auto coarsen = [&](double share, std::size_t most) {
        for (const std::uint8_t least = code_for(share); code > least && count > most; count = triangles())
            --code;
    };
    const std::size_t input = goal.mesh.faces.size();
    coarsen(kLongChordShare, input - input / 4);
    coarsen(kMostChordShare, kMostTriangles * input);
    return code;
}

bool too_many(const Goal& goal, const Outcome& outcome) {
    return outcome.mesh.faces.size() > kMostTriangles * goal.mesh.faces.size();
}

void prove_curved(const Goal& goal, Outcome& outcome, const Task& task) {
    prove(goal, outcome, task);
    const std::uint8_t code = outcome.object.mesh_code;
    for (int finer = kFinerCodes; finer <= kMostFiner && code + finer <= 255; finer += kFinerCodes) {
        const bool may =
            goal.metric == Metric::max && outcome.deviation.max() <= kMaySuffice * goal.tolerance;
        if (outcome.holds || !may || too_many(goal, outcome)) break;
        outcome.object.mesh_code = static_cast<std::uint8_t>(code + finer);
        prove(goal, outcome, task);
    }
    if (too_many(goal, outcome)) outcome.holds = false;
}

Outcome attempt(const Goal& goal, double share, bool curved, const Task& task) {
    Outcome outcome;
    outcome.candidate = "mesh";
    const double reserve = curved ? kReserve * goal.tolerance : 0;
    outcome.object = fit_mesh_part(goal.mesh, {goal.tolerance - reserve, goal.metric, share, curved}, task);
    if (curved) outcome.object.mesh_code = mesh_code_of(goal, outcome.object);
    auto& part = std::get<MeshPart>(outcome.object.shape);
    part = canonical(part);
    if (curved)
        prove_curved(goal, outcome, task);
    else
        prove(goal, outcome, task);
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

// What no look at the surface tells is some thousandths of the tolerance (armadillo at 1e-3: 1.0026 of it).
constexpr double kFlatShare = 0.995;

// Of less and less of the tolerance until one holds; the last always does.
Outcome flat_with_less(const Goal& goal, const Task& task) {
    Outcome outcome;
    for (const double share : {0.95, 0.85, 0.7, 0.5, 0.0}) {
        outcome = attempt(goal, share, false, task);
        if (outcome.holds) break;
    }
    return outcome;
}

Outcome flat_by_max(const Goal& goal, const Task& task) {
    Outcome outcome = attempt(goal, kFlatShare, false, task);
    return outcome.holds ? std::move(outcome) : flat_with_less(goal, task);
}

Outcome flat_by_rms(const Goal& goal, const Task& task) {
    std::optional<Outcome> found = search_rms(goal, false, kNoLimit, task);
    return found ? *std::move(found) : attempt(goal, 0, false, task);
}

// Flat faces are not made where curved ones take fewer bytes than flat ones hardly ever do. With less of the
// tolerance either only becomes more, so that is not tried where the other does no worse with all of it.
Outcome best_by_max(const Goal& goal, const std::optional<MeshEstimate>& known, const Task& task) {
    Outcome curved = attempt(goal, 1, true, task);
    if (curved.holds && curved.bytes < (known ? *known : estimate_mesh(goal, task)).least) return curved;
    Outcome flat = attempt(goal, kFlatShare, false, task);
    for (const double share : {0.96, 0.9}) {
        if (curved.holds || (flat.holds && curved.bytes >= flat.bytes)) break;
        curved = attempt(goal, share, true, task);
    }
    if (!flat.holds && !(curved.holds && curved.bytes < flat.bytes)) flat = flat_with_less(goal, task);
    return curved.holds && curved.bytes < flat.bytes ? std::move(curved) : std::move(flat);
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

Outcome try_mesh(const Goal& goal, const std::optional<MeshEstimate>& known, const Task& task) {
    const bool by_max = goal.metric == Metric::max;
    const bool quick = by_max && goal.mesh.faces.size() <= kMostCurved;
    if (goal.effort == Effort::fast || (goal.effort == Effort::normal && !quick))
        return by_max ? flat_by_max(goal, task) : flat_by_rms(goal, task);
    if (by_max) return best_by_max(goal, known, task);
    Outcome flat = flat_by_rms(goal, task);
    std::optional<Outcome> curved = search_rms(goal, true, flat.bytes, task);
    return curved && curved->bytes < flat.bytes ? *std::move(curved) : flat;
}

}  // namespace pfgeom
