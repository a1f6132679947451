// The parts of a surface that hang together by edges, and what kind of surface each is.
#pragma once

#include "pfgeom/mesh/prepare.h"

#include <vector>

namespace pfgeom {

/// Islands by their lowest face, without `parent`. Counts boundary, non-manifold and misoriented edges and
/// non-manifold vertices into `defects`.
std::vector<Island> find_islands(const TriangleMesh& mesh, MeshDefects& defects, const Task& task);

/// Do all vertices hang together by faces?
bool in_one_piece(const TriangleMesh& mesh);

/// Sets `parent` of each closed and oriented island.
void find_parents(PreparedMesh& prepared, const Task& task);

}  // namespace pfgeom
