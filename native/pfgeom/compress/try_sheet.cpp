#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/sheet.h"

namespace pfgeom {
namespace {

// Of the tolerance: what the surface may miss the samples by, the longest chords, and those that come next.
constexpr double kFitShare = 0.9, kChordShares[] = {0.5, 0.25};

}  // namespace

std::optional<Outcome> try_sheet(const Goal& goal, const Task& task) {
    constexpr std::size_t kSamples = 4000;
    FitTarget target(goal.mesh, kSamples);
    target.add_vertices(goal.mesh);
    const double tolerance = goal.tolerance / target.frame.half();
    const std::optional<SheetFit> fit =
        fit_sheet(in_cube(goal.mesh, target.frame), target, kFitShare * tolerance, rounding_step(tolerance));
    if (!fit) return {};
    for (const double chord : kChordShares) {
        Outcome outcome;
        outcome.candidate = "sheet";
        outcome.functions.resize(2);
        outcome.functions[0].base = fit->surface;
        outcome.functions[1].base = fit->trim;
        outcome.object.frame = target.frame;
        outcome.object.shape = Sheet{0, 1, {}};
        outcome.object.mesh_code = mesh_code_for(goal, chord * goal.tolerance);
        prove(goal, outcome, task);
        if (outcome.holds) return outcome;
    }
    return {};
}

}  // namespace pfgeom
