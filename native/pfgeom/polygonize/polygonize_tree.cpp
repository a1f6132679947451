// A set tree's surface: tetrahedra near it → cut by the tree's questions → the border between those inside
// and outside → adapted to the tolerance. The sources stand in tree_cells.cpp, cut_cells.cpp,
// labelled_mesh.cpp and crease_adapt.cpp.
//
// Why not the dual mesh of polygonize.cpp: a tree's surface is a few quadrics with creases between them, and
// it says which. Cutting cells by the quadrics themselves finds every wall, groove and corner in cells as
// large as the quadrics' bend allows, where signs at the corners of a grid need cells smaller than the
// thinnest of them; and every triangle knows its quadric, so that the mesh can be adapted without asking the
// tree again.
#include "pfgeom/mesh/islands.h"
#include "pfgeom/mesh/weld.h"
#include "pfgeom/polygonize/crease_adapt.h"
#include "pfgeom/polygonize/polygonize.h"

#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

// Largest bend of a question in a cell, in tolerances: what a cut is off by before its vertices move onto the
// quadrics. On fandisk's tree at 2.5e-4 of the diagonal, 2, 4, 8 take 1.8, 1.2, 0.9 s, all for about the same
// triangles and errors.
constexpr double kCellChord = 4;
// Vertices this near to a question's zero set count as on it, in tolerances.
constexpr double kSnap = 0.1;
// Of edges, in tolerances, as in polygonize.cpp.
constexpr double kEdgeChord = 0.75;
// Of vertices, in tolerances.
constexpr double kAccuracy = 0.01;
// Pieces no larger than this, in tolerances, are no part of the shape, which is one piece: bits of what the
// tree leaves open within its tube (a printed part's tree has two, of four vertices each).
constexpr double kBit = 8;

TriangleMesh without_bits(TriangleMesh mesh, double limit) {
    const std::vector<std::vector<std::int32_t>> pieces = find_pieces(mesh);
    if (pieces.size() < 2) return mesh;
    std::vector<char> dropped(mesh.vertices.size());
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        Box box;
        for (const std::int32_t v : pieces[i]) box.grow(mesh.vertices[v]);
        if (norm(box.extent()) > limit) continue;
        for (const std::int32_t v : pieces[i]) dropped[v] = 1;
    }
    std::erase_if(mesh.faces, [&](const Triangle& t) { return dropped[t[0]] != 0; });
    compact_vertices(mesh);
    return mesh;
}

}  // namespace

TriangleMesh polygonize(const SetTree& tree, const PolygonizeOptions& options, const Task& task) {
    check(options);
    const TreePruner pruner(tree);
    LabelledMesh mesh;
    {
        TreeCells cells = cells_near_surface(pruner, options, kCellChord * options.tolerance, task);
        task.report(0.2, "cells");
        cut_cells(pruner, kSnap * options.tolerance, options.max_cells, cells, task);
        task.report(0.4, "cells");
        mesh = manifold_of(boundary_of(pruner, std::move(cells), task));
        task.report(0.6, "triangles");
    }
    const AdaptOptions adapt_options{.edge_tolerance = kEdgeChord * options.tolerance,
                                     .face_tolerance = options.tolerance,
                                     .accuracy = kAccuracy * options.tolerance,
                                     .shortest_edge = 2.0 / std::ldexp(1.0, options.max_depth),
                                     .max_faces = options.max_faces};
    adapt_creases(LabelSurface(pruner), adapt_options, mesh, task);
    task.report(1, "triangles");
    return without_bits({std::move(mesh.mesh.position), mesh.mesh.faces()}, kBit * options.tolerance);
}

}  // namespace pfgeom
