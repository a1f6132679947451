// Where the original surface is farther from a mesh of flat or curved faces than its samples have told.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse_mesh.h"

#include <vector>

namespace pfgeom {

struct MissedPoint {
    Vec3 p;
    std::int32_t origin = -1;  ///< face of the original that it is on
    std::int32_t face = -1;    ///< face of the mesh that is closest to it
    double squared = 0;        ///< distance to that
};

/// Points of the original that are farther than `limit` from the mesh, found by dividing its faces where one
/// may be.
std::vector<MissedPoint> missed_points(const TriangleMesh& original, const CollapseMesh& mesh, double limit,
                                       const Task& task);

}  // namespace pfgeom
