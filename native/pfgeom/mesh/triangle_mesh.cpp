#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

Box bounds(const TriangleMesh& mesh) {
    Box box;
    for (const Triangle& face : mesh.faces)
        for (const std::int32_t v : face) box.grow(mesh.vertices[v]);
    return box;
}

double diagonal(const TriangleMesh& mesh) {
    return bounds(mesh).diagonal();
}

double surface_area(const TriangleMesh& mesh) {
    double twice_area = 0;
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3& a = mesh.vertices[i];
        twice_area += norm(cross(mesh.vertices[j] - a, mesh.vertices[k] - a));
    }
    return twice_area / 2;
}

void append(const TriangleMesh& mesh, TriangleMesh& all) {
    const auto offset = static_cast<std::int32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const Triangle& t : mesh.faces) all.faces.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

}  // namespace pfgeom
