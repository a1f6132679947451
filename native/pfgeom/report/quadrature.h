// Means over a surface of the distance to another: quadrature with stratified samples.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/report/creases.h"
#include "pfgeom/report/deviation.h"

#include <cstddef>
#include <cstdint>

namespace pfgeom {

/// Around creases: what lies there is not smooth. Without creases nothing is called smooth.
struct CreaseZone {
    const Creases* creases = nullptr;
    double reach = 0;
};

struct DistanceMeans {
    double rms = 0, mean = 0, p99 = 0;
    NormalAngles normals, smooth_normals;
    double max = 0;  ///< of the samples, at `worst`
    Vec3 worst;
};

/// `samples` > 0 of the surface of `from`; `to_bvh` is the hierarchy of `to`.
DistanceMeans mean_distances(const TriangleMesh& from, const TriangleMesh& to, const Bvh& to_bvh,
                             const CreaseZone& zone, std::size_t samples, std::uint64_t seed,
                             const Task& task);

}  // namespace pfgeom
