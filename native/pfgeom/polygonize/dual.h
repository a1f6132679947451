// From the octree to the first closed mesh: a vertex a sheet of a leaf, a polygon a crossed edge.
#pragma once

#include "pfgeom/polygonize/octree.h"
#include "pfgeom/polygonize/surface_mesh.h"

namespace pfgeom {

struct DualOptions {
    double accuracy = 0;  ///< of the vertices: how far they may be from the zero set, about
    std::size_t max_faces = 0;
    bool normals = true;  ///< are they wanted?
};

/// A closed 2-manifold. The octree's cells are freed on the way.
SurfaceMesh dual_mesh(Octree& octree, const DualOptions& options, const Task& task);

}  // namespace pfgeom
