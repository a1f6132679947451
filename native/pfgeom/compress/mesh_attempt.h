// One attempt at a mesh part, proved on its bytes.
#pragma once

#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mirror_pose.h"

#include <optional>

namespace pfgeom {

/// What is to be approximated: all of a goal's mesh, or a half of it that is mirrored.
struct WantedMesh {
    const Goal& goal;
    std::optional<MirrorPose> mirror;
};

/// With a share of the tolerance (0: no simplification; of all of a mesh only).
Outcome attempt_mesh(const WantedMesh& wanted, double share, bool curved, const Task& task);

}  // namespace pfgeom
