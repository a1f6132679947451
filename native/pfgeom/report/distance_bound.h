// The largest distance of the points of one surface to another, between proved bounds.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>

namespace pfgeom {

struct DistanceBoundOptions {
    bool refine = true;        ///< false: only the bound that follows from the distances at the vertices
    double gap = 0.005;        ///< done when bound <= (1 + gap) * max
    double certify_below = 0;  ///< > 0: done when bound <= this, or when a point is farther than this
    double resolution = 0;     ///< pieces and distances smaller than this are rounding
    std::int64_t work = 0;     ///< closest-point queries
};

struct DistanceBound {
    double max = 0;  ///< at `worst`
    Vec3 worst;
    double bound = 0;  ///< no point is farther than this
};

/// `known`: a point of the surface and its distance found before. `to_bvh` is the hierarchy of `to`.
DistanceBound bound_distance(const TriangleMesh& from, const TriangleMesh& to, const Bvh& to_bvh,
                             const DistanceBound& known, const DistanceBoundOptions& options,
                             const Task& task);

}  // namespace pfgeom
