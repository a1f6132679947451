// From the octree to the first closed mesh: a vertex a sheet of a leaf, a polygon a crossed edge.
#pragma once

#include "pfgeom/polygonize/octree.h"
#include "pfgeom/polygonize/surface_mesh.h"

namespace pfgeom {

/// Closed 2-manifold, vertices on the zero set to within about `accuracy`.
SurfaceMesh dual_mesh(const Octree& octree, double accuracy, std::size_t max_faces, const Task& task);

}  // namespace pfgeom
