#include "pfgeom/compress/object_mesh.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/eval/nearest_quadric.h"
#include "pfgeom/eval/solid_field.h"
#include "pfgeom/fit/thin.h"
#include "pfgeom/mesh/islands.h"
#include "pfgeom/mesh/weld.h"
#include "pfgeom/polygonize/paint_faces.h"
#include "pfgeom/polygonize/polygonize.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Of the tolerance: far below what a border may be off (paint_fit.cpp, kNear).
constexpr double kSnapShare = 1.0 / 16;
// Of the diagonal, where no tolerance was named.
constexpr double kSnapOfDiagonal = 1e-4;

// How far the default mesh of a set tree may be from the one with its chords, in these. With 2.2 chords
// must be shorter, and there are as many triangles. If vertices moved, they would be 5 to 20 % fewer, but
// flat sides not flat.
constexpr double kThin = 1.5;
// The highest steps that are closed in that mesh, in chords; at chords of a quarter of the tolerance those of
// two tolerances, which no tree exceeds. Not where the rms was promised: there they cost bytes (fandisk at
// 1e-4 266 instead of 240).
constexpr double kHighestStep = 8.5;
// Larger ones stay as they are: it takes 0.05 ms a face, and nobody wants to wait for a mesh.
constexpr std::size_t kMostThinned = 25'000;

PolygonizeOptions polygonize_options(const ObjectsToMesh& all, const Object& object) {
    PolygonizeOptions result;
    result.min_depth = kLeastDepth;
    result.max_depth = kMostDepth;
    const double half = object.frame.half();
    if (all.options.resolution) {
        result.min_depth = result.max_depth = depth_for(half, all.cell_for(object));
    } else {
        result.tolerance = all.chord_for(object) / half;
    }
    return result;
}

Fineness fineness_of(const ObjectsToMesh& all, const Object& object) {
    if (!all.options.resolution) return {.chord = all.chord_for(object)};
    return {.chord = chord_of(object, all.diagonal), .length = all.cell_for(object)};
}

// Where the surface leaves the cube the polygonizer closes it with the cube's sides: they go.
void remove_cube_sides(const ScalarField& field, double chord, TriangleMesh& mesh, const Task& task) {
    constexpr std::size_t kChunk = 1024;
    std::vector<char> off(mesh.vertices.size());
    parallel_chunks(off.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            Vec3 gradient;
            const double value = field.value_and_gradient(mesh.vertices[v], gradient);
            off[v] = std::abs(value) > chord * norm(gradient) ? 1 : 0;
        }
    });
    std::erase_if(mesh.faces, [&](const Triangle& face) {
        return std::ranges::any_of(face,
                                   [&](std::int32_t v) { return off[static_cast<std::size_t>(v)] != 0; });
    });
}

// How far borders may be from where they are, so that faces do not become slivers, in chords of the default
// mesh.
constexpr double kCutSnap = 1.0 / 8;

// Where planes meet beside a border specks may be left, of which a finer mesh sees more: they go over to what
// is around them. Of the default mesh's chords: so large they are at most.
constexpr double kSpeck = 8;
// A sheet is one piece, so whatever else is kept goes, in the middle of a hole too; of the largest piece's
// area. Not all of it: where a neck is too thin for a coarse mesh, what hangs on it stays.
constexpr double kCrumb = 0.01;

void join_specks(const TriangleMesh& mesh, double largest, std::vector<std::int32_t>& parts) {
    struct Piece {
        Box box;
        double area = 0;
    };
    const std::vector<std::int32_t> first = first_of_piece(mesh, parts);
    std::vector<Piece> pieces(parts.size());
    const auto piece = [&](std::size_t f) -> Piece& { return pieces[static_cast<std::size_t>(first[f])]; };
    double most = 0;
    for (std::size_t f = 0; f < parts.size(); ++f) {
        const auto& [a, b, c] = mesh.faces[f];
        const Vec3 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
        piece(f).box.grow(p), piece(f).box.grow(q), piece(f).box.grow(r);
        piece(f).area += norm(cross(q - p, r - p)) / 2;
        if (parts[f] == Sheet::kKept) most = std::max(most, piece(f).area);
    }
    for (std::size_t f = 0; f < parts.size(); ++f) {
        const bool kept = parts[f] == Sheet::kKept;
        if (piece(f).box.diagonal() < largest || (kept && piece(f).area < kCrumb * most))
            parts[f] = kept ? Sheet::kCut : Sheet::kKept;
    }
}

// The function's surface, without what the decision tree cuts away. Lengths in the cube's units.
TriangleMesh mesh_of_cut_sheet(const Model& model, const Sheet& sheet, const PolygonizeOptions& options,
                               double chord, const Task& task) {
    const SolidField field(model, Solid{{{SetNode::Kind::function, sheet.surface}}});
    TriangleMesh mesh = polygonize(field, options, task);
    remove_cube_sides(field, chord, mesh, quiet(task, task.threads));
    const std::vector<const MaterialTree*> trees(mesh.faces.size(), &sheet.cut);
    std::vector<std::int32_t> parts = paint_faces(mesh, Frame{}, trees, kCutSnap * chord, task);
    join_specks(mesh, kSpeck * chord, parts);
    std::size_t kept = 0;
    for (std::size_t f = 0; f < parts.size(); ++f) {
        if (parts[f] == Sheet::kKept) mesh.faces[kept++] = mesh.faces[f];
    }
    mesh.faces.resize(kept);
    compact_vertices(mesh);
    return mesh;
}

TriangleMesh mesh_of_sheet(const Model& model, const ObjectsToMesh& all, const Object& object,
                           const Task& task) {
    const auto& sheet = std::get<Sheet>(object.shape);
    const PolygonizeOptions options = polygonize_options(all, object);
    if (sheet.trim < 0) {
        const double chord = chord_of(object, all.diagonal) / object.frame.half();
        return mesh_of_cut_sheet(model, sheet, options, chord, task);
    }
    const Function& surface = model.functions[static_cast<std::size_t>(sheet.surface)];
    const Function& trim = model.functions[static_cast<std::size_t>(sheet.trim)];
    if (!surface.is_quadric() || !trim.is_quadric())
        throw InvalidInput("a sheet that a function trims cannot be polygonized if it has perturbations");
    return polygonize_sheet(surface.base, trim.base, options, task);
}

}  // namespace

int depth_for(double half, double size) {
    int depth = kLeastDepth;
    while (depth < 12 && std::ldexp(2 * half, -depth) > size) ++depth;
    return depth;
}

double largest_scale(const Object& object) {
    double largest = 0;
    for (const Similarity& s : copies_of(object)) largest = std::max(largest, s.scale);
    return largest;
}

double ObjectsToMesh::largest_half() const {
    double largest = 0;
    for (const Object& o : list) largest = std::max(largest, o.frame.half() * largest_scale(o));
    return largest;
}

double ObjectsToMesh::chord_for(const Object& object) const {
    return options.tolerance ? *options.tolerance / largest_scale(object) : chord_of(object, diagonal);
}

double ObjectsToMesh::cell_for(const Object& object) const {
    return 2 * largest_half() / *options.resolution / largest_scale(object);
}

void turn_faces(TriangleMesh& mesh) {
    for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
}

// A complement fills the cube; its surface is that of its operand, with the faces turned.
TriangleMesh mesh_in_place(const Model& model, const ObjectsToMesh& all, const Object& object,
                           const Task& task) {
    if (std::holds_alternative<MeshPart>(object.shape))
        return mesh_of(object, fineness_of(all, object), task);
    const PolygonizeOptions how = polygonize_options(all, object);
    TriangleMesh mesh;
    bool complement = false;
    if (const auto* solid = std::get_if<Solid>(&object.shape)) {
        complement = !solid->nodes.empty() && solid->nodes.back().kind == SetNode::Kind::complement;
        Solid shape = *solid;
        if (complement) shape.nodes.pop_back();
        mesh = polygonize(model, shape, how, task);
    } else if (const auto* tree = std::get_if<SetTree>(&object.shape)) {
        complement = tree->complement;
        PolygonizeOptions closed = how;
        if (all.thin() && model.promise.metric == Metric::max)
            closed.highest_step = kHighestStep * how.tolerance;
        mesh = polygonize(*tree, closed, task);
    } else {
        mesh = mesh_of_sheet(model, all, object, task);
    }
    for (Vec3& v : mesh.vertices) v = object.frame.to_world(v);
    if (all.thin() && std::holds_alternative<SetTree>(object.shape) && mesh.faces.size() <= kMostThinned)
        mesh = thinned(mesh, kThin * chord_of(object, all.diagonal), task);
    if (complement || object.cavity_of >= 0) turn_faces(mesh);
    return mesh;
}

TriangleMesh copy_of(TriangleMesh mesh, const Similarity& s) {
    for (Vec3& v : mesh.vertices) v = s.apply(v);
    if (dot(s.rows[0], cross(s.rows[1], s.rows[2])) < 0) turn_faces(mesh);
    return mesh;
}

double border_snap(const Model& model) {
    const double tolerance = model.promise.tolerance;
    return tolerance > 0 ? kSnapShare * tolerance : kSnapOfDiagonal * model.diagonal;
}

std::vector<std::int32_t> paint_mesh(TriangleMesh& mesh, const Object& object, const Paint& paint,
                                     double snap, const Task& task) {
    const MaterialTree& first = paint.trees.front();
    if (!paint.by_quadric && first.nodes.size() == 1)
        return std::vector<std::int32_t>(mesh.faces.size(), first.nodes.front().material);
    std::vector<const MaterialTree*> tree_of(mesh.faces.size(), &first);
    if (paint.by_quadric) {
        const std::vector<std::int32_t> quadrics =
            nearest_quadrics(std::get<SetTree>(object.shape), object.frame, mesh, task);
        for (std::size_t f = 0; f < tree_of.size(); ++f)
            tree_of[f] = &paint.trees[static_cast<std::size_t>(quadrics[f])];
    }
    return paint_faces(mesh, object.frame, tree_of, snap, task);
}

}  // namespace pfgeom
