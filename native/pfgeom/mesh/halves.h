// A mesh cut in two by a plane across an axis, the halves laid on each other.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// Where a coordinate is `at`.
struct AxisPlane {
    int axis = 0;
    double at = 0;
};

/// The half above the plane, its cut exactly on it, all other vertices beyond. Vertices nearer to the plane
/// than `near` are moved onto it, and faces that then lie in it are left out.
TriangleMesh half_above(const TriangleMesh& mesh, const AxisPlane& plane, double near);

/// The mirror image, its faces turned round.
TriangleMesh mirrored(TriangleMesh mesh, const AxisPlane& plane);

}  // namespace pfgeom
