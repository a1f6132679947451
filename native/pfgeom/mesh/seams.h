// Boundary edges that coincide become one edge.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>

namespace pfgeom {

/// Joins boundary vertices that are within `distance` of each other, and splits faces where boundary vertices
/// lie on their boundary edges (T-junctions). No vertex gets new coordinates: faces get other vertices, no
/// more than `distance` away. Returns how many boundary edges found a partner and are inner edges now.
std::int64_t close_seams(TriangleMesh& mesh, double distance, const Task& task);

}  // namespace pfgeom
