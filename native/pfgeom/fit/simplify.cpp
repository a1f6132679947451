#include "pfgeom/fit/simplify.h"

#include "pfgeom/base/error.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/curved_part.h"
#include "pfgeom/fit/fitted_surface.h"
#include "pfgeom/fit/grid.h"
#include "pfgeom/fit/mend_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

// Grid steps in tolerances, tried in turn until the vertices find places that keep the tolerance. Bytes at
// 1e-3 of the diagonal, with lattices of up to 4 steps, at 0.6, 0.8 and 1: 1877, 1828, 1749 (os-plane), 1622,
// 1543, 1502 (beetle-alt). Parts with many corners need the finer ones.
constexpr std::array<double, 6> kSteps{1.1, 0.95, 0.8, 0.55, 0.38, 0.25};
// What collapses may use, so that vertices find places on coarse lattices. Of 0.75, 0.8 and 0.85 (os-plane:
// 1941 bytes at the first, 1725 at the last) the largest is the best.
constexpr double kCollapseShare = 0.85;
// The third round takes off another percent (beetle-alt: 1085, 1019, 1010 faces).
constexpr int kRounds = 3;
// The rms says nothing about single points: they may be this many tolerances off.
constexpr double kWorstOfRms = 8;

}  // namespace

Object fit_mesh_part(const TriangleMesh& mesh, const MeshPartOptions& options, const Task& task) {
    if (!(options.tolerance > 0)) throw InvalidInput("the tolerance must be above 0");
    if (mesh.faces.empty()) throw InvalidInput("a mesh part needs at least one face");
    if (options.share <= 0) return part_on_grid(mesh, Grid::around(bounds(mesh), options.tolerance / 8));

    if (options.curved) return fit_curved_part(mesh, options, task);
    const bool by_max = options.metric == Metric::max;
    const double goal = options.tolerance * options.share;
    const FittedSurface surface(mesh, options);
    CollapseMesh work = surface.start(false);
    CollapseError error = surface.error(goal, collapse_spacing(mesh, goal), task);
    const double share = kCollapseShare * goal, size = surface.box().diagonal();
    const CollapseLimits inner{options.metric, share, by_max ? share : kWorstOfRms * goal, size};
    for (int round = 0; round < kRounds; ++round) {
        task.report(static_cast<double>(round) / (kRounds + 1), "simplify");
        if (round > 0) relax_vertices(work, error, inner, task);
        collapse_edges(work, error, inner, task);
    }
    const CollapseLimits outer{options.metric, goal, by_max ? goal : kWorstOfRms * goal, size};
    relax_vertices(work, error, outer, task);
    if (work.face_count() > options.most_faces) return part_on_grid({}, surface.grid(goal));
    MendedPart part{{}, SIZE_MAX};
    for (const double step : kSteps) {
        const Grid grid = surface.grid(step * goal);
        CollapseMesh snapped = work;
        CollapseError snapped_error = error;
        if (!snap_vertices(snapped, snapped_error, outer, grid, step == kSteps.back(), task)) continue;
        snapped_error.quantise(grid, 0);
        MendedPart found = mended_part(surface.original(), snapped, snapped_error, outer, grid, 0, task);
        if (found.wrong < part.wrong) part = std::move(found);
        if (part.wrong == 0) break;
    }
    task.report(1, "simplify");
    return std::move(part.object);
}

}  // namespace pfgeom
