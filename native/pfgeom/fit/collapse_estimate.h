// How far edge collapses would get, in a twentieth of the time: by plane quadrics alone, without a look at
// distances.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pfgeom {

/// Vertices that are left when no collapse has a root mean square below each of `limits`, which rise:
/// distances from the new vertex to the planes of the faces that it replaces.
std::vector<std::size_t> vertices_after_collapses(const TriangleMesh& mesh, std::span<const double> limits,
                                                  const Task& task);

}  // namespace pfgeom
