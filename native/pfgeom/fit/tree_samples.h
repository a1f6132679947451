// Points of space with their side, from which a tree is built: in shells around the surface, from the edge of
// the tube outwards. Points inside the tube are free, so there are none there.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/base/task.h"
#include "pfgeom/mesh/signed_distance.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

struct TreeSample {
    Vec3 point;
    std::int32_t patch = -1;  ///< the quadric of the nearest face
    bool inside = false;
};

struct SampleOptions {
    double tube = 0;  ///< distance from which on the side counts
    std::size_t count =
        60000;  ///< points of the surface for the innermost shell; half as many for each next one
    std::uint64_t seed = 1;
};

/// Samples within the box, in an order without a pattern. `patches`: of each face.
std::vector<TreeSample> sample_sides(const TriangleMesh& mesh, const SignedDistance& distance, const Box& box,
                                     const std::vector<std::int32_t>& patches, const SampleOptions& options,
                                     const Task& task);

}  // namespace pfgeom
