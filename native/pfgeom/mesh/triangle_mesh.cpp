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

}  // namespace pfgeom
