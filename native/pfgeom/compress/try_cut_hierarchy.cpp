// A creased free form, as castings with machined faces are, or sculptures with flat bases: what lies on
// quadrics is cut off by them, and the hierarchy is fitted to what is left as if it went on beyond.
#include "pfgeom/compress/hierarchy_search.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/cuts.h"
#include "pfgeom/fit/quadric.h"
#include "pfgeom/fit/target.h"
#include "pfgeom/function/affine.h"
#include "pfgeom/mesh/weld.h"

#include <functional>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

// Of the surface, what the hierarchy must be left with: else it is a part of quadrics, a tree.
constexpr double kLeastLeft = 0.3;
// How far what closes the rest bulges beyond a cut, in radii of its border: so that the hierarchy crosses the
// cut instead of turning along it. Of 0, 0.25, 0.5 and 1 the third is best (docs/HIERARCHY.md).
constexpr double kBulge = 0.5;

class Cutter {
  public:
    Cutter(const Goal& goal, const Task& task)
        : mesh_(goal.mesh),
          tolerance_(goal.tolerance),
          frame_(Frame::around(bounds(mesh_))),
          cuts_(find_cuts(in_cube(mesh_, frame_), within(frame_), rounding_step(within(frame_)), task)) {
        for (const Cut& cut : cuts_) {
            parts_.push_back({mesh_.vertices, {}});
            TriangleMesh& part = parts_.back();
            for (const std::int32_t f : cut.faces) part.faces.push_back(mesh_.faces[f]);
            compact_vertices(part);
        }
    }

    bool pays() const {
        double cut = 0;
        for (const TriangleMesh& part : parts_) cut += surface_area(part);
        return cut > 0 && cut <= (1 - kLeastLeft) * surface_area(mesh_);
    }

    // What is left, closed beyond the cuts.
    ClosedIsland rest() const {
        std::vector<char> cut(mesh_.faces.size());
        for (const Cut& c : cuts_)
            for (const std::int32_t f : c.faces) cut[f] = 1;
        TriangleMesh rest{mesh_.vertices, {}};
        for (std::size_t f = 0; f < cut.size(); ++f)
            if (cut[f] == 0) rest.faces.push_back(mesh_.faces[f]);
        compact_vertices(rest);
        ClosedIsland closed = close_holes(rest);
        closed.fit_closing = false;
        bulge(rest.vertices.size(), closed);
        return closed;
    }

    // Intersects the solid with the quadrics.
    void operator()(Outcome& solid) const {
        const Frame& frame = solid.object.frame;
        const Affine back = composed(inverse_of(affine_of(frame_)), affine_of(frame));
        Solid shape{{{.kind = SetNode::Kind::function, .a = 0}}};
        for (std::size_t i = 0; i < cuts_.size(); ++i) {
            const auto function = static_cast<std::int32_t>(solid.functions.size());
            solid.functions.emplace_back().base =
                scaled_and_rounded(substituted(cuts_[i].quadric, back), in_cube(parts_[i], frame).vertices,
                                   rounding_step(within(frame)));
            const auto node = static_cast<std::int32_t>(shape.nodes.size());
            shape.nodes.push_back({.kind = SetNode::Kind::function, .a = function});
            shape.nodes.push_back({.kind = SetNode::Kind::intersect, .a = node - 1, .b = node});
        }
        solid.candidate = "cut hierarchy";
        solid.object.shape = std::move(shape);
    }

  private:
    double within(const Frame& frame) const { return tolerance_ / frame.half(); }

    // Fans around vertices in the plane of a cut, which stand behind the first `own`, become cones.
    void bulge(std::size_t own, ClosedIsland& closed) const {
        TriangleMesh& mesh = closed.mesh;
        std::vector<double> radii(mesh.vertices.size()), count(mesh.vertices.size());
        for (std::size_t f = closed.own_faces; f < mesh.faces.size(); ++f) {
            const auto& [to, from, middle] = mesh.faces[f];
            radii[middle] += norm(mesh.vertices[from] - mesh.vertices[middle]);
            ++count[middle];
        }
        for (std::size_t v = own; v < mesh.vertices.size(); ++v) {
            const Vec3 p = frame_.to_local(mesh.vertices[v]);
            for (const Cut& cut : cuts_) {
                if (first_order_distance(cut.quadric, p) > within(frame_)) continue;
                mesh.vertices[v] -= kBulge * radii[v] / count[v] * normalized(cut.quadric.gradient(p));
                break;
            }
        }
    }

    const TriangleMesh& mesh_;
    double tolerance_;
    Frame frame_;  // in whose cube the quadrics are
    std::vector<Cut> cuts_;
    std::vector<TriangleMesh> parts_;  // that they serve
};

}  // namespace

std::optional<Outcome> try_cut_hierarchy(const Goal& goal, std::size_t most_bytes, const Task& task) {
    if (goal.inward) return {};
    const Cutter cutter(goal, task);
    if (!cutter.pays()) return {};
    return search_hierarchy(goal, cutter.rest(), std::cref(cutter), most_bytes, task);
}

}  // namespace pfgeom
