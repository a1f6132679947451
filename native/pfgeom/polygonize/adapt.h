// From the first closed mesh to one with as few triangles as the tolerance allows.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/polygonize/cube_field.h"
#include "pfgeom/polygonize/surface_mesh.h"

namespace pfgeom {

struct AdaptOptions {
    double edge_tolerance = 0;  ///< largest distance aimed at between an edge and the zero set
    double face_tolerance = 0;  ///< the same at the middle of a face
    double accuracy = 0;        ///< of new vertices
    double shortest_edge = 0;   ///< shorter ones are not split
    std::size_t max_faces = 0;  ///< LimitExceeded above
};

/// Merges, splits and turns edges; `mesh` stays a closed 2-manifold with its vertices on the zero set.
void adapt(const CubeField& field, const AdaptOptions& options, SurfaceMesh& mesh, const Task& task);

}  // namespace pfgeom
