// A creased free form, as castings with machined faces are, or sculptures with flat bases: what lies on
// quadrics is cut off by them, and the hierarchy is fitted to what is left as if it went on beyond.
#include "pfgeom/base/reproducible.h"
#include "pfgeom/compress/hierarchy_search.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/cuts.h"
#include "pfgeom/fit/quadric.h"
#include "pfgeom/fit/target.h"
#include "pfgeom/function/affine.h"
#include "pfgeom/mesh/weld.h"

#include <cmath>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

// Of the surface, what the hierarchy must be left with: else it is a part of quadrics, a tree.
constexpr double kLeastLeft = 0.3;
// How far what closes the rest bulges beyond a cut, in radii of its border: so that the hierarchy crosses the
// cut instead of turning along it.
constexpr double kBulge = 0.5;

// The quadrics are positive inside.
struct Cutters {
    Frame frame;  // in whose cube they are
    std::vector<Quadric> quadrics;
    std::vector<std::vector<Vec3>> points;  // of each, in the world
};

// The rest of the island, closed beyond the cuts.
ClosedIsland close_beyond(const TriangleMesh& island, const std::vector<Cut>& cuts, const Cutters& cutters,
                          double tolerance) {
    std::vector<char> cut(island.faces.size());
    for (const Cut& c : cuts)
        for (const std::int32_t f : c.faces) cut[f] = 1;
    TriangleMesh rest{island.vertices, {}};
    for (std::size_t f = 0; f < cut.size(); ++f)
        if (cut[f] == 0) rest.faces.push_back(island.faces[f]);
    compact_vertices(rest);
    ClosedIsland closed = close_holes(rest);
    closed.fit_closing = false;
    TriangleMesh& mesh = closed.mesh;
    std::vector<double> radius(mesh.vertices.size()), count(mesh.vertices.size());
    for (std::size_t f = closed.own_faces; f < mesh.faces.size(); ++f) {
        const auto& [to, from, middle] = mesh.faces[f];
        radius[middle] += norm(mesh.vertices[from] - mesh.vertices[middle]);
        ++count[middle];
    }
    for (std::size_t v = rest.vertices.size(); v < mesh.vertices.size(); ++v) {
        const Vec3 p = cutters.frame.to_local(mesh.vertices[v]);
        for (const Quadric& q : cutters.quadrics) {
            if (first_order_distance(q, p) > tolerance) continue;
            mesh.vertices[v] -= kBulge * radius[v] / count[v] * normalized(q.gradient(p));
            break;
        }
    }
    return closed;
}

// Intersects the solid with the cutters.
void intersect(const Cutters& cutters, double tolerance, Outcome& solid) {
    const Frame& frame = solid.object.frame;
    const Affine back = composed(inverse_of(affine_of(cutters.frame)), affine_of(frame));
    const double step = rounding_step(tolerance / frame.half());
    Solid shape{{{.kind = SetNode::Kind::function, .a = 0}}};
    for (std::size_t i = 0; i < cutters.quadrics.size(); ++i) {
        std::vector<Vec3> points = cutters.points[i];
        for (Vec3& p : points) p = frame.to_local(p);
        const auto function = static_cast<std::int32_t>(solid.functions.size());
        solid.functions.emplace_back().base =
            scaled_and_rounded(substituted(cutters.quadrics[i], back), points, step);
        const auto node = static_cast<std::int32_t>(shape.nodes.size());
        shape.nodes.push_back({.kind = SetNode::Kind::function, .a = function});
        shape.nodes.push_back({.kind = SetNode::Kind::intersect, .a = node - 1, .b = node});
    }
    solid.candidate = "cut hierarchy";
    solid.object.shape = std::move(shape);
}

}  // namespace

std::optional<Outcome> try_cut_hierarchy(const Goal& goal, std::size_t most_bytes, const Task& task) {
    if (goal.inward) return {};
    Cutters cutters{Frame::around(bounds(goal.mesh)), {}, {}};
    const TriangleMesh local = in_cube(goal.mesh, cutters.frame);
    const double tolerance = goal.tolerance / cutters.frame.half();
    const std::vector<Cut> cuts = find_cuts(local, tolerance, rounding_step(tolerance), task);
    if (cuts.empty()) return {};
    TriangleMesh off{goal.mesh.vertices, {}};
    for (const Cut& cut : cuts) {
        cutters.quadrics.push_back(cut.quadric);
        std::vector<Vec3>& points = cutters.points.emplace_back();
        for (const std::int32_t f : cut.faces) {
            off.faces.push_back(goal.mesh.faces[f]);
            for (const std::int32_t v : goal.mesh.faces[f]) points.push_back(goal.mesh.vertices[v]);
        }
    }
    if (surface_area(off) > (1 - kLeastLeft) * surface_area(goal.mesh)) return {};
    const ClosedIsland closed = close_beyond(goal.mesh, cuts, cutters, tolerance);
    const auto finish = [&](Outcome& solid) { intersect(cutters, goal.tolerance, solid); };
    return search_hierarchy(goal, closed, finish, most_bytes, task);
}

}  // namespace pfgeom
