#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/compress.h"

#include <algorithm>

namespace pfgeom {
namespace {

// As many as the measurement of the whole takes in the end, so that one island that holds here holds there.
std::size_t samples_for(const TriangleMesh& mesh) {
    return std::clamp<std::size_t>(mesh.faces.size() * 20, 10'000, 200'000);
}

// What other samples say differs: the rms of closed surfaces by some 0.2 %; of cut sheets, whose error is
// largest in strips along the borders, by 0.6 % (stanford-bunny at 1e-4).
constexpr double kRmsShare = 0.995, kRmsShareOfSheets = 0.985;

// `rms_share`: of the tolerance, what the rms may be.
Measured measured_within(const Goal& goal, const TriangleMesh& mesh, double rms_share, const Task& task) {
    const bool by_max = goal.metric == Metric::max;
    DeviationOptions options;
    options.samples = by_max ? 0 : samples_for(goal.mesh);
    options.bound = by_max;
    options.certify_below = by_max ? goal.tolerance : 0;
    const Bvh bvh(mesh);
    const auto once_more = [&] { return measure_deviation(goal.mesh, goal.bvh, mesh, bvh, options, task); };
    Deviation d = once_more();
    if (by_max && !d.certified && d.max() <= goal.tolerance) {  // neither proved nor refuted
        options.samples = samples_for(goal.mesh);
        d = once_more();
    }
    const double error = by_max ? (d.certified ? d.max_bound() : d.max()) : d.rms();
    return {d, error <= (by_max ? 1.0 : rms_share) * goal.tolerance};
}

}  // namespace

Model model_of(const Goal& goal, const Outcome& outcome) {
    Model model;
    model.functions = outcome.functions;
    model.objects = {outcome.object};
    model.diagonal = goal.diagonal;
    model.promise = {goal.metric, goal.tolerance, goal.tolerance, false, goal.tolerance};
    return model;
}

void take_maximum(const Deviation& more, Deviation& deviation) {
    for (const auto side : {&Deviation::a_to_b, &Deviation::b_to_a}) {
        OneSided& mine = deviation.*side;
        const OneSided& other = more.*side;
        if (other.max > mine.max) mine.max = other.max, mine.worst = other.worst;
        mine.max_bound = std::max(mine.max_bound, other.max_bound);
    }
    deviation.certified = more.certified;
}

Measured measure(const Goal& goal, const TriangleMesh& mesh, const Task& task) {
    return measured_within(goal, mesh, kRmsShare, task);
}

void prove(const Goal& goal, Outcome& outcome, const Task& task) {
    outcome.holds = false;
    const std::vector<std::uint8_t> bytes = encode(model_of(goal, outcome));
    outcome.bytes = bytes.size();
    const Result<Model> decoded = decode(bytes);
    if (!decoded) return;  // asks for more work than its size allows: no file may
    outcome.functions = decoded->functions;
    outcome.object = decoded->objects.front();
    try {
        outcome.mesh = to_mesh(*decoded, {.thin = !goal.painted}, task);
    } catch (const LimitExceeded&) {
        return;
    }
    if (outcome.mesh.faces.empty()) return;
    const bool sheet = std::holds_alternative<Sheet>(outcome.object.shape);
    const double share = sheet ? kRmsShareOfSheets : kRmsShare;
    const Measured measured = measured_within(goal, outcome.mesh, share, task);
    outcome.deviation = measured.deviation;
    outcome.holds = measured.holds;
}

}  // namespace pfgeom
