// The parts of a surface that hang together by edges, and what kind of surface each is.
#pragma once

#include "pfgeom/mesh/prepare.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// Islands by their lowest face, without `parent`. Counts boundary, non-manifold and misoriented edges and
/// non-manifold vertices into `defects`.
std::vector<Island> find_islands(const TriangleMesh& mesh, MeshDefects& defects, const Task& task);

/// The vertices that hang together by faces, the largest set first.
std::vector<std::vector<std::int32_t>> find_pieces(const TriangleMesh& mesh);

/// For each face the first of those with its label that it hangs together with by edges.
std::vector<std::int32_t> first_of_piece(const TriangleMesh& mesh, std::span<const std::int32_t> labels);

/// Sets `parent` of each closed and oriented island.
void find_parents(PreparedMesh& prepared, const Task& task);

}  // namespace pfgeom
