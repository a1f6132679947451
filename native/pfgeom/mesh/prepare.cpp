#include "pfgeom/mesh/prepare.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/sort_unique.h"
#include "pfgeom/mesh/islands.h"
#include "pfgeom/mesh/seams.h"
#include "pfgeom/mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace pfgeom {
namespace {

/// One vertex for each point, no face without area, none twice.
void weld(TriangleMesh& mesh, MeshDefects& defects, const Task& task) {
    const std::vector<std::int32_t> representative = exact_representatives(mesh);
    for (std::size_t row = 0; row < representative.size(); ++row) {
        if (representative[row] < 0)
            ++defects.unused_vertices;
        else if (representative[row] != static_cast<std::int32_t>(row))
            ++defects.duplicate_vertices;
    }
    reindex(mesh.faces, representative);
    task.check();
    defects.degenerate_faces += remove_repeated_corners(mesh.faces);
    defects.degenerate_faces += remove_zero_area(mesh);
    defects.duplicate_faces += remove_duplicates(mesh.faces);
}

/// Joined vertices can make faces equal to others; those that lost their area stay, since they close holes.
void join_seams(TriangleMesh& mesh, double seam_distance, MeshDefects& defects, const Task& task) {
    defects.seam_edges = close_seams(mesh, seam_distance, task);
    if (defects.seam_edges == 0) return;
    defects.degenerate_faces += remove_repeated_corners(mesh.faces);
    defects.duplicate_faces += remove_duplicates(mesh.faces);
}

}  // namespace

PreparedMesh prepare_mesh(const TriangleMesh& input, double seam_distance, const Task& task) {
    check_mesh(input);
    if (!(seam_distance >= 0) || !std::isfinite(seam_distance))
        throw InvalidInput("the seam distance " + std::to_string(seam_distance) + " is no length");
    PreparedMesh prepared;
    prepared.diagonal = diagonal(input);
    prepared.mesh = input;
    weld(prepared.mesh, prepared.defects, task);
    join_seams(prepared.mesh, seam_distance, prepared.defects, task);
    compact_vertices(prepared.mesh);
    prepared.islands = find_islands(prepared.mesh, prepared.defects, task);
    find_parents(prepared, task);
    return prepared;
}

TriangleMesh extract_island(const PreparedMesh& prepared, const Island& island) {
    std::vector<std::int32_t> rows;  // of the whole mesh, rising: linear in the island, not in the mesh
    rows.reserve(3 * island.faces.size());
    for (const std::int32_t face : island.faces)
        for (const std::int32_t v : prepared.mesh.faces[face]) rows.push_back(v);
    sort_unique(rows);

    TriangleMesh out;
    for (const std::int32_t row : rows) out.vertices.push_back(prepared.mesh.vertices[row]);
    const auto own = [&](std::int32_t row) {
        return static_cast<std::int32_t>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
    };
    for (const std::int32_t face : island.faces) {
        const auto& [i, j, k] = prepared.mesh.faces[face];
        out.faces.push_back({own(i), own(j), own(k)});
    }
    return out;
}

}  // namespace pfgeom
