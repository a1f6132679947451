// Equal points become one vertex, and faces that are then nothing or nothing new go. Everything happens to
// the faces' indices; vertices keep their rows until `compact_vertices`.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// For each vertex that a face uses, the lowest used row with the same coordinates (-0 equals 0); -1 for
/// unused.
std::vector<std::int32_t> exact_representatives(const TriangleMesh& mesh);

/// Replaces every index of a face by map[index].
void reindex(std::vector<Triangle>& faces, std::span<const std::int32_t> map);

/// Each removes faces, keeps the order of the others, and returns how many it removed.
std::int64_t remove_repeated_corners(std::vector<Triangle>& faces);
std::int64_t remove_zero_area(TriangleMesh& mesh);
std::int64_t remove_duplicates(std::vector<Triangle>& faces);  ///< the same three indices again, in any order

/// Drops vertices without a face; the others keep their order.
void compact_vertices(TriangleMesh& mesh);

}  // namespace pfgeom
