#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/quadric.h"

#include <cmath>

namespace pfgeom {

std::optional<Outcome> try_quadric(const Goal& goal, const Task& task) {
    constexpr std::size_t kSamples = 4000;
    const FitTarget target(goal.mesh, kSamples);
    const double tolerance = goal.tolerance / target.frame.half();
    // A power of two near a sixteenth of the tolerance: ten roundings together stay well below it.
    int exponent = 0;
    std::frexp(tolerance / 16, &exponent);
    const std::optional<QuadricFit> fit = fit_quadric(target, std::ldexp(1.0, exponent - 1));
    if (!fit || (goal.metric == Metric::max ? fit->max : fit->rms) > tolerance) return {};
    Outcome outcome;
    outcome.candidate = "quadric";
    outcome.functions.resize(1);
    outcome.functions[0].base = fit->quadric;
    outcome.object.frame = target.frame;
    outcome.object.shape = single_function(goal.inward);
    outcome.object.mesh_code = mesh_code_for(goal, goal.tolerance / 4);
    prove(goal, outcome, task);
    if (!outcome.holds) return {};
    return outcome;
}

}  // namespace pfgeom
