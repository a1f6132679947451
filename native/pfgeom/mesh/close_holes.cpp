#include "pfgeom/mesh/close_holes.h"

#include "pfgeom/mesh/edges.h"

#include <vector>

namespace pfgeom {

ClosedIsland close_holes(const TriangleMesh& island) {
    ClosedIsland closed{island, island.faces.size()};
    TriangleMesh& mesh = closed.mesh;
    const EdgeTable edges(island.faces, island.vertices.size());
    std::vector<std::int32_t> next(island.vertices.size(), -1);  // along the borders
    for (const std::int32_t side : edges.boundary()) {
        const Triangle& face = island.faces[static_cast<std::size_t>(side / 3)];
        next[static_cast<std::size_t>(face[side % 3])] = face[(side + 1) % 3];
    }
    for (std::size_t start = 0; start < next.size(); ++start) {
        if (next[start] < 0) continue;
        const auto middle = static_cast<std::int32_t>(mesh.vertices.size());
        Vec3 sum;
        int count = 0;
        auto from = static_cast<std::int32_t>(start);
        while (next[static_cast<std::size_t>(from)] >= 0) {
            const std::int32_t to = next[static_cast<std::size_t>(from)];
            next[static_cast<std::size_t>(from)] = -1;
            mesh.faces.push_back({to, from, middle});
            sum += mesh.vertices[from];
            ++count;
            from = to;
        }
        mesh.vertices.push_back(sum / count);
    }
    return closed;
}

}  // namespace pfgeom
