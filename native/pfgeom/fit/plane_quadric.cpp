#include "pfgeom/fit/plane_quadric.h"

namespace pfgeom {

std::vector<PlaneQuadric> plane_quadrics(const CollapseMesh& mesh) {
    std::vector<PlaneQuadric> quadrics(mesh.vertex_count());
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const auto v = static_cast<std::int32_t>(i);
        const std::vector<std::int32_t> rims = mesh.neighbours(v, false);
        for (const std::int32_t f : mesh.faces_at(v)) {
            const auto t = mesh.corners(f);
            const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
            quadrics[i].add(normalized(n), t[0], norm(n));
            for (const std::int32_t w : mesh.face(f)) {  // borders hold their place across the surface
                if (!std::binary_search(rims.begin(), rims.end(), w)) continue;
                const Vec3 edge = mesh.point(w) - mesh.point(v);
                quadrics[i].add(normalized(cross(edge, n)), mesh.point(v), squared_norm(edge));
            }
        }
    }
    return quadrics;
}

}  // namespace pfgeom
