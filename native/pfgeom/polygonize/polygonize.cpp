// Octree → dual mesh → mesh adapted to the tolerance. The octree finds all sheets and gives a closed manifold
// with cells a little coarser than needed; merging, splitting and turning edges (which keep it a manifold)
// then remove what the cells' powers of two and their squareness waste. The sources stand in octree.cpp,
// leaf_surface.cpp, dual.cpp and adapt.cpp.
#include "pfgeom/polygonize/polygonize.h"

#include "pfgeom/base/error.h"
#include "pfgeom/mesh/weld.h"
#include "pfgeom/polygonize/adapt.h"
#include "pfgeom/polygonize/dual.h"

#include <cmath>

namespace pfgeom {
namespace {

// Chord of the octree's cells, in tolerances. On igea's hierarchy at 3e-5 of the diagonal, 2, 3, 4, 6
// take 4.7, 3.5, 3.0, 2.5 s of CPU, all for 351,000 triangles; the largest errors at 1e-4
// are 2.0, 2.5, 3.2, 8.5 tolerances.
constexpr double kCellChord = 3;
// Of edges, in tolerances: in the middle of an equilateral triangle on a sphere the chord is 4/3 of the
// edges'.
constexpr double kEdgeChord = 0.75;
// Of vertices, in tolerances: does not show beside the chord.
constexpr double kAccuracy = 0.05;

}  // namespace

void check(const PolygonizeOptions& options) {
    if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
        throw InvalidInput("polygonize: the tolerance must be a positive number");
    if (options.min_depth < 0 || options.min_depth > options.max_depth || options.max_depth > kDeepest)
        throw InvalidInput("polygonize: depths must satisfy 0 <= min_depth <= max_depth <= 20");
}

TriangleMesh polygonize(const ScalarField& field, const PolygonizeOptions& options, const Task& task) {
    check(options);
    const CubeField cube(field, options.max_depth);
    const double accuracy = kAccuracy * options.tolerance;
    const bool adaptive = options.min_depth < options.max_depth;
    SurfaceMesh mesh;
    {
        Octree octree(cube, options, kCellChord * options.tolerance, task);
        mesh = dual_mesh(octree, {accuracy, options.max_faces, adaptive}, task);
    }
    task.check();
    if (adaptive) {
        const AdaptOptions adapt_options{.edge_tolerance = kEdgeChord * options.tolerance,
                                         .face_tolerance = options.tolerance,
                                         .accuracy = accuracy,
                                         .shortest_edge = cube.step(),
                                         .max_faces = options.max_faces};
        mesh.find_neighbours();
        adapt(cube, adapt_options, mesh, task);
        mesh.compact();
    }
    TriangleMesh result{std::move(mesh.position), mesh.take_faces()};
    compact_vertices(result);
    task.report(1, "triangles");
    return result;
}

}  // namespace pfgeom
