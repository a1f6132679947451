#include "pfgeom/polygonize/polygonize.h"

#include "pfgeom/base/error.h"
#include "pfgeom/polygonize/adapt.h"
#include "pfgeom/polygonize/dual.h"

namespace pfgeom {
namespace {

static double kCellChord = getenv("KC") ? atof(getenv("KC")) : 4;
static double kEdge = getenv("KE") ? atof(getenv("KE")) : 0.75;

}  // namespace

TriangleMesh polygonize(const ScalarField& field, const PolygonizeOptions& options, const Task& task) {
    if (!(options.tolerance > 0)) throw InvalidInput("polygonize: tolerance must be above 0");
    if (options.min_depth < 0 || options.min_depth > options.max_depth || options.max_depth > kDeepest)
        throw InvalidInput("polygonize: depths must satisfy 0 <= min_depth <= max_depth <= 20");
    const CubeField cube(field, options.max_depth);
    const double accuracy = 0.05 * options.tolerance;
    SurfaceMesh mesh;
    {
        const Octree octree(cube, options, kCellChord * options.tolerance, task);
        mesh = dual_mesh(octree, accuracy, options.max_faces, task);
    }
    if (options.min_depth < options.max_depth) {
        task.report(0.7, "triangles");
        adapt(cube, {kEdge * options.tolerance, accuracy, cube.step(), options.max_faces}, mesh, task);
    }
    mesh.compact();
    return {std::move(mesh.position), mesh.faces()};
}

}  // namespace pfgeom
