// Seams are closed for good rather than remembered: afterwards a crack is an ordinary edge with two faces,
// and winding numbers, simplification and islands need no special case. In the spirit of Borodin, Novotni,
// Klein, "Progressive gap closing for mesh repairing", 2002 (vertices to vertices, then vertices to edges),
// but in one pass, within a fixed small distance.
#include "pfgeom/mesh/seams.h"

#include "pfgeom/base/sort_unique.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/near_vertices.h"
#include "pfgeom/mesh/point_tree.h"
#include "pfgeom/mesh/split_faces.h"
#include "pfgeom/mesh/weld.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

using Sides = std::vector<std::int32_t>;  // 3 * face + corner
using Edge = std::pair<std::int32_t, std::int32_t>;

Edge ends_of(const std::vector<Triangle>& faces, std::int32_t side) {
    const Triangle& face = faces[side / 3];
    return {face[side % 3], face[(side % 3 + 1) % 3]};
}

std::vector<std::int32_t> vertices_of(const std::vector<Triangle>& faces, const Sides& sides) {
    std::vector<std::int32_t> vertices;
    for (const std::int32_t side : sides) {
        const auto [a, b] = ends_of(faces, side);
        vertices.insert(vertices.end(), {a, b});
    }
    sort_unique(vertices);
    return vertices;
}

/// The boundary vertices on each boundary side, in its direction.
std::vector<SideChain> find_chains(const TriangleMesh& mesh, const Sides& boundary, double distance,
                                   const Task& task) {
    const std::vector<std::int32_t> vertices = vertices_of(mesh.faces, boundary);
    std::vector<Vec3> points;
    points.reserve(vertices.size());
    for (const std::int32_t v : vertices) points.push_back(mesh.vertices[v]);
    const PointTree tree(std::move(points));

    std::vector<SideChain> chains;
    std::vector<std::int32_t> near;
    std::vector<std::pair<double, std::int32_t>> along;
    for (const std::int32_t side : boundary) {
        task.check();
        const Triangle& face = mesh.faces[side / 3];
        const auto [from, to] = ends_of(mesh.faces, side);
        const Vec3 &a = mesh.vertices[from], &b = mesh.vertices[to];
        tree.near_segment(a, b, distance, near);
        along.clear();
        for (const std::int32_t row : near) {
            const std::int32_t v = vertices[row];
            const double t = nearest_parameter(mesh.vertices[v], a, b);
            if (t > 0 && t < 1 && std::find(face.begin(), face.end(), v) == face.end())
                along.emplace_back(t, v);
        }
        std::sort(along.begin(), along.end());
        chains.push_back({side, {}});
        for (const auto& [t, v] : along) chains.back().inner.push_back(v);
    }
    return chains;
}

/// Calls visit(a, b) for the pieces of a side that its chain makes.
template <class Visit>
void for_each_piece(const std::vector<Triangle>& faces, const SideChain& chain, Visit visit) {
    const auto [from, to] = ends_of(faces, chain.side);
    std::int32_t a = from;
    for (const std::int32_t b : chain.inner) visit(std::exchange(a, b), b);
    visit(a, to);
}

/// Takes the vertices of a chain away if none of its pieces meets a piece of another side: nothing is gained.
void drop_useless(const std::vector<Triangle>& faces, std::vector<SideChain>& chains) {
    std::vector<Edge> pieces;
    for (const SideChain& chain : chains)
        for_each_piece(faces, chain,
                       [&](std::int32_t a, std::int32_t b) { pieces.push_back(std::minmax(a, b)); });
    std::sort(pieces.begin(), pieces.end());
    for (SideChain& chain : chains) {
        bool useful = false;
        for_each_piece(faces, chain, [&](std::int32_t a, std::int32_t b) {
            const auto [first, last] =
                std::equal_range(pieces.begin(), pieces.end(), Edge(std::minmax(a, b)));
            useful = useful || last - first > 1;
        });
        if (!useful) chain.inner.clear();
    }
}

}  // namespace

std::int64_t close_seams(TriangleMesh& mesh, double distance, const Task& task) {
    task.check();
    const Sides boundary = EdgeTable(mesh.faces, mesh.vertices.size()).boundary();
    if (boundary.empty()) return 0;
    task.check();
    reindex(mesh.faces, near_representatives(mesh, vertices_of(mesh.faces, boundary), distance, task));

    const Sides open = EdgeTable(mesh.faces, mesh.vertices.size()).boundary();
    std::vector<SideChain> chains = find_chains(mesh, open, distance, task);
    drop_useless(mesh.faces, chains);
    const std::vector<Triangle> whole = std::exchange(mesh.faces, split_faces(mesh.faces, chains));

    // A boundary side was a seam if all its pieces have partners now.
    const EdgeTable edges(mesh.faces, mesh.vertices.size());
    auto seams = static_cast<std::int64_t>(boundary.size() - open.size());
    for (const SideChain& chain : chains) {
        bool closed = true;
        for_each_piece(whole, chain,
                       [&](std::int32_t a, std::int32_t b) { closed = closed && edges.count(a, b) > 1; });
        if (closed) ++seams;
    }
    return seams;
}

}  // namespace pfgeom
