#include "pfgeom/fit/plane_quadric.h"

#include "pfgeom/base/box.h"

namespace pfgeom {
namespace {

// A quadric's value is a difference of squares of coordinates: of a mesh that lies so many times its size
// from zero, some 1e-5 of the size are lost. (At 1e8 a gear's 160 faces take minutes, since the quadrics say
// nothing.)
constexpr double kFar = 1e3;

Vec3 origin_of(const CollapseMesh& mesh) {
    Box box;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) box.grow(mesh.point(static_cast<std::int32_t>(v)));
    const Vec3 centre = box.centre();
    return norm(centre) > kFar * box.diagonal() ? centre : Vec3{};
}

}  // namespace

std::vector<PlaneQuadric> plane_quadrics(const CollapseMesh& mesh) {
    PlaneQuadric none;
    none.origin = origin_of(mesh);
    std::vector<PlaneQuadric> quadrics(mesh.vertex_count(), none);
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
