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
#include "pfgeom/polygonize/close_steps.h"
#include "pfgeom/polygonize/crease_adapt.h"
#include "pfgeom/polygonize/polygonize.h"
#include "pfgeom/polygonize/unfold.h"

#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

// Largest bend of a question in a cell, in tolerances: what a cut is off by before its vertices move onto the
// quadrics. On fandisk's tree at 2.5e-4 of the diagonal, 2, 4, 8 take 1.8, 1.2, 0.9 s, all for about the same
// triangles and errors.
constexpr double kCellChord = 4;
// Vertices this near to a question's zero set count as on it, in tolerances. Plates thinner than twice that
// can vanish. With 0.045 one of a tenth of the tolerance does not, but tri-plate_holes takes 173 instead of
// 165 bytes at 1e-3; with 0.02 a part's folded edges double.
constexpr double kSnap = 0.1;
// Of edges, in tolerances, as in polygonize.cpp.
constexpr double kEdgeChord = 0.75;
// Of vertices, in tolerances.
constexpr double kAccuracy = 0.01;
// Pieces beside the largest whose volume over their area is less than this, in tolerances, are no part of the
// shape, which is one piece: slivers that the tree leaves within its tube (a printed part's has two, of four
// vertices each, up to 20 long).
constexpr double kBit = 1.0 / 3;

// In heights of the highest step, as steps are wide that slope.
constexpr double kLongestBesideFolds = 2;

struct Extent {
    double volume = 0, area = 0;
};

// Of each piece: six times, and twice.
std::vector<Extent> extents(const TriangleMesh& mesh, const std::vector<std::int32_t>& piece_of,
                            std::size_t pieces) {
    std::vector<Extent> all(pieces);
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        Extent& extent = all[piece_of[i]];
        extent.volume += dot(a, cross(b, c));
        extent.area += norm(cross(b - a, c - a));
    }
    return all;
}

TriangleMesh without_bits(TriangleMesh mesh, double thickness) {
    const std::vector<std::vector<std::int32_t>> pieces = find_pieces(mesh);
    if (pieces.size() < 2) return mesh;
    std::vector<std::int32_t> piece_of(mesh.vertices.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (const std::int32_t v : pieces[i]) piece_of[v] = static_cast<std::int32_t>(i);
    }
    const std::vector<Extent> extent = extents(mesh, piece_of, pieces.size());
    std::erase_if(mesh.faces, [&](const Triangle& t) {
        const auto& [volume, area] = extent[piece_of[t[0]]];
        return piece_of[t[0]] > 0 && std::abs(volume) <= 3 * thickness * area;
    });
    compact_vertices(mesh);
    return mesh;
}

// What the trim leaves of the solid below the surface.
SetTree solid_of_sheet(const Quadric& surface, const Quadric& trim) {
    SetTree tree;
    tree.resolution = 8;
    constexpr std::int32_t kWide = 129 << 2;  // the cube and a 128th, which cells reach beyond
    tree.low = {-kWide, -kWide, -kWide};
    tree.high = {kWide, kWide, kWide};
    tree.quadrics.resize(2);
    tree.quadrics[0].quadric = surface;
    tree.quadrics[1].quadric = trim;
    tree.nodes.resize(5);
    tree.nodes[0] = {.kind = TreeNode::Kind::ask, .quadric = 0, .high = 1, .low = 4};
    tree.nodes[1] = {.kind = TreeNode::Kind::ask, .quadric = 1, .high = 2, .low = 3};
    tree.nodes[2].kind = TreeNode::Kind::inside;
    return tree;
}

LabelledMesh labelled_mesh_of(const CutSolid& solid, const PolygonizeOptions& options, const Task& task) {
    check(options);
    LabelledMesh mesh;
    {
        TreeCells cells = cells_near_surface(solid, options, kCellChord * options.tolerance, task);
        task.report(0.2, "cells");
        cut_cells(solid, kSnap * options.tolerance, options.max_cells, cells, task);
        task.report(0.4, "cells");
        mesh = manifold_of(boundary_of(solid, std::move(cells), task));
        task.report(0.6, "triangles");
    }
    const AdaptOptions adapt_options{.edge_tolerance = kEdgeChord * options.tolerance,
                                     .face_tolerance = options.tolerance,
                                     .accuracy = kAccuracy * options.tolerance,
                                     .shortest_edge = 2.0 / std::ldexp(1.0, options.max_depth),
                                     .max_faces = options.max_faces};
    const LabelSurface surface(solid);
    adapt_creases(surface, adapt_options, mesh, task);
    if (options.highest_step > 0) {
        close_steps(surface, options.highest_step, mesh, task);
        unfold(kLongestBesideFolds * options.highest_step, mesh, task);
    }
    task.report(1, "triangles");
    return mesh;
}

}  // namespace

TriangleMesh polygonize(const CutSolid& solid, const PolygonizeOptions& options, const Task& task) {
    LabelledMesh mesh = labelled_mesh_of(solid, options, task);
    return without_bits({std::move(mesh.mesh.position), mesh.mesh.take_faces()}, kBit * options.tolerance);
}

TriangleMesh polygonize(const SetTree& tree, const PolygonizeOptions& options, const Task& task) {
    return polygonize(CutSolid(TreePruner(tree)), options, task);
}

TriangleMesh polygonize_sheet(const Quadric& surface, const Quadric& trim, const PolygonizeOptions& options,
                              const Task& task) {
    const CutSolid below(TreePruner(solid_of_sheet(surface, trim)));
    LabelledMesh solid = labelled_mesh_of(below, options, task);
    TriangleMesh sheet{std::move(solid.mesh.position), {}};
    for (std::size_t f = 0; f < solid.label.size(); ++f)
        if (below.quadric(solid.label[f] / 2) == surface) sheet.faces.push_back(solid.mesh.faces()[f]);
    compact_vertices(sheet);
    return sheet;
}

}  // namespace pfgeom
