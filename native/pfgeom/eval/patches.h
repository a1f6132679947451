// A mesh of flat triangles near the curved ones of a mesh part.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <limits>

namespace pfgeom {

/// How finely curved edges are divided: until no piece is further than `chord` from the curve, nor longer
/// than `length`.
struct Fineness {
    double chord = std::numeric_limits<double>::infinity();
    double length = std::numeric_limits<double>::infinity();
};

/// Of a curved part. Neighbours divide their common edge alike, so there are no cracks. Throws LimitExceeded
/// beyond Limits::polygon_faces, and Cancelled.
TriangleMesh divide_patches(const Object& object, const Fineness& fineness, const Task& task = {});

}  // namespace pfgeom
