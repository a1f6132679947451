#include "pfgeom/mesh/islands.h"

#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/union_find.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

namespace pfgeom {
namespace {

std::vector<Island> gather(UnionFind& sets, std::size_t faces, std::vector<std::int32_t>& island_of) {
    std::vector<Island> islands;
    island_of.resize(faces);
    for (std::size_t i = 0; i < faces; ++i) {
        const auto face = static_cast<std::int32_t>(i);
        const std::int32_t root = sets.find(face);  // the lowest face, so seen already
        if (root == face) {
            island_of[i] = static_cast<std::int32_t>(islands.size());
            islands.push_back({.faces = {}, .closed = true, .manifold = true, .oriented = true});
        } else {
            island_of[i] = island_of[root];
        }
        islands[island_of[i]].faces.push_back(face);
    }
    return islands;
}

void classify_edges(const EdgeTable& edges, const std::vector<std::int32_t>& island_of,
                    std::vector<Island>& islands, MeshDefects& defects) {
    edges.for_each([&](std::span<const EdgeUse> uses) {
        Island& island = islands[island_of[uses[0].face()]];
        std::size_t forward = 0;
        for (const EdgeUse& use : uses) forward += use.forward;
        const bool balanced = forward == uses.size() / 2 || forward == (uses.size() + 1) / 2;
        if (uses.size() % 2 == 1) island.closed = false;
        if (uses.size() > 2) island.manifold = false;
        if (!balanced) island.oriented = false;
        defects.boundary_edges += uses.size() == 1;
        defects.non_manifold_edges += uses.size() > 2;
        defects.misoriented_edges += uses.size() == 2 && !balanced;
    });
}

/// The corners at a vertex are joined by the edges there; more than one set means more than one fan.
void classify_vertices(const TriangleMesh& mesh, const EdgeTable& edges,
                       const std::vector<std::int32_t>& island_of, std::vector<Island>& islands,
                       MeshDefects& defects) {
    UnionFind corners(3 * mesh.faces.size());
    const auto corner_at = [&](const EdgeUse& use, bool lo) {
        const std::int32_t next = use.side % 3 == 2 ? use.side - 2 : use.side + 1;
        return lo == use.forward ? use.side : next;
    };
    edges.for_each([&](std::span<const EdgeUse> uses) {
        for (const EdgeUse& use : uses.subspan(1))
            for (const bool lo : {false, true}) corners.join(corner_at(uses[0], lo), corner_at(use, lo));
    });
    std::vector<std::int32_t> fan_of(mesh.vertices.size(), -1);
    std::vector<bool> counted(mesh.vertices.size(), false);
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(3 * mesh.faces.size()); ++corner) {
        const std::int32_t vertex = mesh.faces[corner / 3][corner % 3], fan = corners.find(corner);
        if (fan_of[vertex] < 0) fan_of[vertex] = fan;
        if (fan_of[vertex] == fan) continue;
        islands[island_of[corner / 3]].manifold = false;
        islands[island_of[fan_of[vertex] / 3]].manifold = false;
        if (!counted[vertex]) ++defects.non_manifold_vertices;
        counted[vertex] = true;
    }
}

/// Area, and volume by the divergence theorem about a point of the island, which keeps digits far from the
/// origin.
void measure(const TriangleMesh& mesh, Island& island) {
    const Vec3 origin = mesh.vertices[mesh.faces[island.faces[0]][0]];
    for (const std::int32_t face : island.faces) {
        const auto& [i, j, k] = mesh.faces[face];
        const Vec3 a = mesh.vertices[i] - origin, b = mesh.vertices[j] - origin,
                   c = mesh.vertices[k] - origin;
        island.area += norm(cross(b - a, c - a)) / 2;
        island.signed_volume += dot(a, cross(b, c)) / 6;
    }
}

}  // namespace

std::vector<Island> find_islands(const TriangleMesh& mesh, MeshDefects& defects, const Task& task) {
    task.check();
    const EdgeTable edges(mesh.faces, mesh.vertices.size());
    task.check();
    UnionFind sets(mesh.faces.size());
    edges.for_each([&](std::span<const EdgeUse> uses) {
        for (const EdgeUse& use : uses.subspan(1)) sets.join(uses[0].face(), use.face());
    });
    std::vector<std::int32_t> island_of;
    std::vector<Island> islands = gather(sets, mesh.faces.size(), island_of);
    task.check();
    classify_edges(edges, island_of, islands, defects);
    task.check();
    classify_vertices(mesh, edges, island_of, islands, defects);
    for (Island& island : islands) measure(mesh, island);
    return islands;
}

std::vector<std::vector<std::int32_t>> find_pieces(const TriangleMesh& mesh) {
    UnionFind joined(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.faces) {
        joined.join(a, b);
        joined.join(a, c);
    }
    std::vector<std::int32_t> piece_of(mesh.vertices.size(), -1);
    std::vector<std::vector<std::int32_t>> pieces;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const auto v = static_cast<std::int32_t>(i);
        const std::int32_t root = joined.find(v);  // the lowest, so seen already
        if (root == v) {
            piece_of[i] = static_cast<std::int32_t>(pieces.size());
            pieces.emplace_back();
        }
        pieces[piece_of[root]].push_back(v);
    }
    std::ranges::stable_sort(pieces, std::greater<>{}, &std::vector<std::int32_t>::size);
    return pieces;
}

std::vector<std::int32_t> first_of_piece(const TriangleMesh& mesh, std::span<const std::int32_t> labels) {
    const auto label = [&](std::int32_t face) { return labels[static_cast<std::size_t>(face)]; };
    UnionFind joined(mesh.faces.size());
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        for (const EdgeUse& use : uses.subspan(1)) {
            if (label(use.face()) == label(uses[0].face())) joined.join(uses[0].face(), use.face());
        }
    });
    std::vector<std::int32_t> first(mesh.faces.size());
    for (std::size_t f = 0; f < first.size(); ++f) first[f] = joined.find(static_cast<std::int32_t>(f));
    return first;
}

}  // namespace pfgeom
