#include "pfgeom/render/ray_mesh.h"

#include "pfgeom/eval/mesh_part.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Curved faces are drawn as triangles this close to them, as a share of the diagonal: a hundredth of a pixel
// in a picture of a thousand. The default mesh's share of its chord tolerance is the coarsest.
constexpr double kChord = 1e-5, kChordShare = 0.25;

}  // namespace

RayMesh::RayMesh(const Object& object, double diagonal, const Task& task)
    : RayMesh(
          mesh_of(object, {.chord = std::min(kChord * diagonal, kChordShare * chord_of(object, diagonal))}),
          task) {}

RayMesh::RayMesh(const TriangleMesh& mesh, const Task& task) : bvh_(mesh, task) {
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

}  // namespace pfgeom
