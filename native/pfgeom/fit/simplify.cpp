#include "pfgeom/fit/simplify.h"

#include <algorithm>
#include <cmath>

#include "pfgeom/base/error.h"
#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/grid.h"

#include <cstdlib>
namespace pfgeom {
namespace {
double envd(const char*n,double d){ const char*s=getenv(n); return s?atof(s):d; }
}
namespace {

MeshPart part_of(const TriangleMesh& mesh, const Grid& grid) {
    MeshPart part;
    part.step_code = grid.step_code;
    part.faces = mesh.faces;
    part.positions.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) part.positions.push_back(grid.nearest(v));
    return part;
}

Object object_of(const TriangleMesh& mesh, const Grid& grid) {
    Object object;
    object.frame = grid.frame;
    object.shape = part_of(mesh, grid);
    return object;
}

}  // namespace

Object fit_mesh_part(const TriangleMesh& mesh, const MeshPartOptions& options, const Task& task) {
    if (!(options.tolerance > 0)) throw InvalidInput("tolerance must be positive");
    const Box box = bounds(mesh);
    if (options.share <= 0) return object_of(mesh, Grid::around(box, options.tolerance / 8));
    const double goal = options.tolerance * options.share;
    const Grid grid = Grid::around(box, envd("STEP",0.6) * goal);
    CollapseMesh work(mesh);
    CollapseError error(mesh, options.metric, goal, std::max(envd("SPACING",6) * goal, std::sqrt(surface_area(mesh) / 2e5)));
    const bool by_max = options.metric == Metric::max;
    CollapseLimits limits{options.metric, envd("SIMP",0.85)*goal, by_max ? envd("SIMP",0.85)*goal : 8 * goal, box.diagonal()};
    for (int round = 0; round < (int)envd("ROUNDS",3); ++round) {
        if (round > 0) relax_vertices(work, error, limits, task);
        collapse_edges(work, error, limits, task);
        if(getenv("VERB")) fprintf(stderr,"round %d faces %zu\n",round,work.face_count());
    }
    limits.forward = goal;
    limits.backward = by_max ? goal : 8 * goal;
    relax_vertices(work, error, limits, task);
    snap_vertices(work, error, limits, grid, task);
    return object_of(work.result(), grid);
}

}  // namespace pfgeom
