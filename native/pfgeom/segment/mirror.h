// The plane in which a surface is its own mirror image, or nearly so.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <optional>

namespace pfgeom {

/// Where dot(normal, x) = at. The normal is a unit vector, an axis where that does as well.
struct Mirror {
    Vec3 normal;
    double at = 0;
    double deviation = 0;  ///< the farthest that the image of a vertex is from the surface

    Vec3 image(const Vec3& p) const { return p - 2 * (dot(normal, p) - at) * normal; }
};

/// The best one found, unless images are farther than `most` from the surface. `bvh`: of the mesh.
std::optional<Mirror> find_mirror(const TriangleMesh& mesh, const Bvh& bvh, double most, const Task& task);

}  // namespace pfgeom
