#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/compress.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Enough for the rms to be right within half a percent; the final measurement takes the default, and a proof
// leaves it that half percent.
constexpr double kRmsShare = 0.995;
std::size_t samples_for(const TriangleMesh& mesh) {
    return std::clamp<std::size_t>(mesh.faces.size() * 10, 10'000, 100'000);
}

// A file of this one object.
Model model_of(const Goal& goal, const Outcome& outcome) {
    Model model;
    model.functions = outcome.functions;
    model.objects = {outcome.object};
    model.diagonal = goal.diagonal;
    model.promise = {goal.metric, goal.tolerance, goal.tolerance, false, goal.tolerance};
    return model;
}

}  // namespace

void prove(const Goal& goal, Outcome& outcome, const Task& task) {
    const bool by_max = goal.metric == Metric::max;
    outcome.holds = false;
    const std::vector<std::uint8_t> bytes = encode(model_of(goal, outcome));
    outcome.bytes = bytes.size();
    const Result<Model> decoded = decode(bytes);
    if (!decoded) return;  // asks for more work than its size allows: no file may
    outcome.functions = decoded->functions;
    outcome.object = decoded->objects.front();
    try {
        outcome.mesh = to_mesh(*decoded, {}, task);
    } catch (const LimitExceeded&) {
        return;
    }
    if (outcome.mesh.faces.empty()) return;
    DeviationOptions options;
    options.samples = by_max ? 0 : samples_for(goal.mesh);
    options.bound = by_max;
    options.certify_below = by_max ? goal.tolerance : 0;
    const Bvh bvh(outcome.mesh);
    const auto measure = [&] {
        outcome.deviation = measure_deviation(goal.mesh, goal.bvh, outcome.mesh, bvh, options, task);
    };
    measure();
    const Deviation& d = outcome.deviation;
    if (by_max && !d.certified && d.max() <= goal.tolerance) {  // neither proved nor refuted
        options.samples = samples_for(goal.mesh);
        measure();
    }
    const double error = by_max ? (d.certified ? d.max_bound() : d.max()) : d.rms();
    outcome.holds = error <= (by_max ? 1.0 : kRmsShare) * goal.tolerance;
}

}  // namespace pfgeom
