#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/patch_loop.h"

#include <limits>

namespace pfgeom {
namespace {

void relax(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, std::int32_t v) {
    Patch patch;
    mesh.patch_of_move(v, mesh.point(v), patch);
    const double before = error.forward(patch, std::numeric_limits<double>::infinity());
    if (patch.curved())
        error.refit(patch, true);
    else
        patch.move_to(error.fitted(patch));
    if (!mesh.keeps_orientation(patch) || !(error.forward(patch, before) < before)) return;
    if (!error.stays_near(patch, limits.backward)) return;
    error.commit(patch);
    mesh.move(v, patch);
}

}  // namespace

void relax_vertices(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits,
                    const Task& task) {
    const std::vector<std::int32_t> vertices = mesh.vertices_left();
    PatchLoop loop(mesh, error);
    for (const std::int32_t v : vertices) loop.add(mesh.faces_at(v));
    loop.run(task, [&](std::size_t i) { relax(mesh, error, limits, vertices[i]); });
}

}  // namespace pfgeom
