#include "pfgeom/render/ray_mesh.h"

#include "pfgeom/eval/mesh_part.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Curved faces are drawn as triangles this close to them, as a share of the diagonal: a hundredth of a pixel
// in a picture of a thousand. The default mesh's share of its chord tolerance is the coarsest.
constexpr double kChord = 1e-5, kChordShare = 0.25;

double chord_for(const Object& object, double diagonal) {
    return std::min(kChord * diagonal, kChordShare * chord_of(object, diagonal));
}

}  // namespace

RayMesh::RayMesh(const Object& object, double diagonal, const Task& task)
    : RayMesh(mesh_of(object, {.chord = chord_for(object, diagonal)}), task) {
    const auto* part = std::get_if<MeshPart>(&object.shape);
    if (part != nullptr && part->curved()) chord_ = chord_for(object, diagonal);
}

RayMesh::RayMesh(const TriangleMesh& mesh, const Task& task) : bvh_(mesh, task), vertices_(mesh.vertices) {
    const auto vertex = [&mesh](std::int32_t i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3 a = vertex(i), b = vertex(j), c = vertex(k);
        normals_.push_back(normalized(cross(b - a, c - a)));
        boxes_.push_back({min(min(a, b), c), max(max(a, b), c)});
    }
}

SurfaceHit RayMesh::first_hit(const Ray& ray, const RaySpan& span) const {
    const RayHit hit = bvh_.first_hit(ray.origin, ray.direction, span.from, span.to);
    if (hit.face < 0) return {};
    return {hit.t, normals_[static_cast<std::size_t>(hit.face)], -1, hit.face};
}

Extreme RayMesh::extreme(const SearchGoal& goal, double within, double /*accuracy*/,
                         ExtremeSearch& /*search*/) const {
    Extreme best;
    if (goal.along) {
        for (const Vec3& v : vertices_) {
            if (goal.cost(v) < best.cost) best = {v, goal.cost(v), goal.cost(v)};
        }
    } else {
        const ClosestPoint closest = bvh_.closest(goal.place, within);
        const double distance = std::sqrt(closest.squared_distance);
        if (closest.face >= 0) best = {closest.point, distance, distance};
        best.proved = std::min(distance, within);
    }
    best.proved -= chord_;
    return best;
}

}  // namespace pfgeom
