// One attempt at a mesh part, proved on its bytes.
#pragma once

#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mirror_pose.h"

#include <cstddef>
#include <optional>

namespace pfgeom {

/// What is to be approximated: all of a goal's mesh, or a half of it that is mirrored.
struct WantedMesh {
    const Goal& goal;
    std::optional<MirrorPose> mirror;
    std::size_t most_bytes = kAnyBytes;  ///< more are of no use

    bool too_large(const Outcome& outcome) const { return outcome.bytes > most_bytes; }
};

/// With a share of the tolerance (0: no simplification; of all of a mesh only). Gives up, without a mesh,
/// where it sees that it takes too many bytes.
Outcome attempt_mesh(const WantedMesh& wanted, double share, bool curved, const Task& task);

}  // namespace pfgeom
