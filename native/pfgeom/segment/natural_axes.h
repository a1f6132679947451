// The axes that a part was drawn along, however it lies.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <array>

namespace pfgeom {

/// Orthonormal rows, a turn, after which much of the area faces along axes; the third has most. The identity
/// where it does as well, or where no direction has much.
std::array<Vec3, 3> natural_axes(const TriangleMesh& mesh);

}  // namespace pfgeom
