// How a surface lies so that the plane of its mirror is across an axis, which mesh parts need.
#pragma once

#include "pfgeom/compress/candidate.h"
#include "pfgeom/function/placement.h"
#include "pfgeom/mesh/halves.h"

#include <optional>

namespace pfgeom {

struct MirrorPose {
    AxisPlane plane;
    TriangleMesh mesh;      ///< where it is, or turned
    Placements placements;  ///< that turn it back; empty: it is where it is
};

/// Of the goal's mesh, if it has a mirror and, where the plane is askew, may have placements.
std::optional<MirrorPose> mirror_pose(const Goal& goal, const std::optional<Mirror>& mirror);

}  // namespace pfgeom
