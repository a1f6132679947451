#include "pfgeom/mesh/signed_distance.h"

#include "pfgeom/mesh/angle.h"
#include "pfgeom/mesh/edges.h"

namespace pfgeom {

SignedDistance::SignedDistance(const TriangleMesh& mesh, const Bvh& bvh)
    : mesh_(mesh), bvh_(bvh), vertex_normals_(mesh.vertices.size()), edge_normals_(mesh.faces.size()) {
    face_normals_.reserve(mesh.faces.size());
    for (const Triangle& t : mesh.faces) {
        const Vec3 n = normalized(
            cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
        face_normals_.push_back(n);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.vertices[t[k]];
            const double angle =
                angle_between(mesh.vertices[t[(k + 1) % 3]] - p, mesh.vertices[t[(k + 2) % 3]] - p);
            vertex_normals_[t[k]] += n * angle;
        }
    }
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        Vec3 sum;
        for (const EdgeUse& use : uses) sum += face_normals_[use.face()];
        for (const EdgeUse& use : uses)
            edge_normals_[use.face()][static_cast<std::size_t>(use.side % 3)] = sum;
    });
}

Vec3 SignedDistance::normal_at(std::int32_t face, const Vec3& p) const {
    constexpr double kOnEdge = 1e-9;  // of the face's height
    const Triangle& t = mesh_.faces[face];
    std::array<bool, 3> on_side{};  // the side opposite to each corner
    int sides = 0;
    const Vec3& a = mesh_.vertices[t[0]];
    const Vec3 ab = mesh_.vertices[t[1]] - a, ac = mesh_.vertices[t[2]] - a, n = cross(ab, ac);
    const double whole = squared_norm(n), v = dot(cross(p - a, ac), n), w = dot(cross(ab, p - a), n);
    const std::array<double, 3> share{whole - v - w, v, w};
    for (std::size_t k = 0; k < 3; ++k) sides += on_side[k] = share[k] <= kOnEdge * whole;
    if (sides == 0 || sides == 3) return face_normals_[face];
    for (std::size_t k = 0; k < 3; ++k) {
        if (sides == 2 && !on_side[k]) return vertex_normals_[t[k]];
        if (sides == 1 && on_side[k]) return edge_normals_[face][(k + 1) % 3];
    }
    return face_normals_[face];
}

SignedClosest SignedDistance::operator()(const Vec3& p, std::int32_t hint) const {
    const ClosestPoint c = bvh_.closest(p, Box::kInf, hint);
    const double distance = std::sqrt(c.squared_distance);
    const bool outside = dot(p - c.point, normal_at(c.face, c.point)) > 0;
    return {outside ? -distance : distance, c.face, c.point};
}

}  // namespace pfgeom
