#include "pfgeom/eval/mirror_image.h"

#include <cstddef>

namespace pfgeom {

double world_place(const Frame& frame, const MirrorPlane& plane) {
    Vec3 local;
    local[plane.axis] = plane.at;
    return frame.to_world(local)[plane.axis];
}

void add_mirror_image(const Frame& frame, const MirrorPlane& plane, TriangleMesh& mesh) {
    const double at = world_place(frame, plane);
    const std::size_t vertices = mesh.vertices.size(), faces = mesh.faces.size();
    std::vector<std::int32_t> image(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        Vec3 p = mesh.vertices[v];
        image[v] = static_cast<std::int32_t>(p[plane.axis] == at ? v : mesh.vertices.size());
        if (p[plane.axis] == at) continue;
        p[plane.axis] = 2 * at - p[plane.axis];
        mesh.vertices.push_back(p);
    }
    for (std::size_t f = 0; f < faces; ++f) {
        const auto of = [&](std::size_t k) { return image[static_cast<std::size_t>(mesh.faces[f][k])]; };
        mesh.faces.push_back({of(0), of(2), of(1)});
    }
}

}  // namespace pfgeom
