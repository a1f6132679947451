#include "pfgeom/fit/curved_part.h"

#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/fitted_surface.h"
#include "pfgeom/fit/grid.h"
#include "pfgeom/fit/mend_patches.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Steps of the grid in tolerances, and of the bulges over it in eighths of an octave.
constexpr double kStep = 0.8;
// By the rms, to which rounding adds a third of a step at most: cheburashka at 1e-4 takes 7,380, 6,900, 6,620
// and 6,650 bytes with 0.8, 1, 1.25 and 1.6.
constexpr double kStepOfRms = 1.4;
constexpr int kBulgeCode = 4;
// What collapses may use before the vertices are on the grid (then nearly all find a place), and after: what
// is collapsed on the grid has paid for its rounding already.
constexpr double kFirstShare = 0.75, kLaterShare = 0.97;
// What coarser lattices may use, and whatever is mended in the end, of the whole tolerance.
constexpr double kLatticeShare = 0.98, kAll = 0.999;
constexpr int kRounds = 3;
// The first collapses leave up to so many times the faces that there are in the end (1.28 to 1.43 on five
// meshes).
constexpr double kShrinks = 1.7;
// As in simplify.cpp.
constexpr double kWorstOfRms = 8;

}  // namespace

Object fit_curved_part(const TriangleMesh& mesh, const MeshPartOptions& options, const Task& task) {
    const FittedSurface surface(mesh, options);
    const bool by_max = options.metric == Metric::max;
    const double goal = options.tolerance * options.share;
    const auto within = [&](double share) {
        return CollapseLimits{options.metric, share * goal, (by_max ? share : kWorstOfRms) * goal,
                              surface.box().diagonal()};
    };
    CollapseMesh work = surface.start(true);
    CollapseError error = surface.error(goal, collapse_spacing(mesh, goal), task);
    error.follow_lines(surface.original(), task);
    task.report(0, "patches");
    collapse_edges(work, error, within(kFirstShare), task);
    relax_vertices(work, error, within(kFirstShare), task);
    const Grid grid = surface.grid((by_max ? kStep : kStepOfRms) * goal);
    const auto too_many = [&](double shrinks) {
        return static_cast<double>(work.face_count()) > shrinks * static_cast<double>(options.most_faces);
    };
    if (too_many(kShrinks)) return part_on_grid({}, grid);
    snap_vertices(work, error, within(kLaterShare), grid, false, task);
    const int bulge_code = grid.step_code + kBulgeCode;
    error.quantise(grid, grid.frame.half() * exp2_eighths(bulge_code));
    for (int round = 1; round <= kRounds; ++round) {
        task.report(static_cast<double>(round) / (kRounds + 2), "patches");
        relax_vertices(work, error, within(kLaterShare), task);
        collapse_edges(work, error, within(kLaterShare), task);
    }
    if (too_many(1)) return part_on_grid({}, grid);
    snap_vertices(work, error, within(kLatticeShare), grid, true, task);
    // Nothing is gained by mending what keeps the tolerance itself.
    const double all = by_max ? std::max(1.0, kAll / options.share) : 1;
    MendedPart part = mended_part(surface.original(), work, error, within(all), grid, bulge_code, task);
    task.report(1, "patches");
    return std::move(part.object);
}

}  // namespace pfgeom
