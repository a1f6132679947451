// Islands that are copies of one another: moved, turned, mirrored, grown. Found by moments; who uses them
// proves them.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/placement.h"
#include "pfgeom/mesh/prepare.h"

#include <cstddef>
#include <vector>

namespace pfgeom {

struct Copy {
    std::size_t island = 0;
    Similarity place;  ///< brings the first of the group here
};

/// The first is the largest; it is in place. At least two.
using CopyGroup = std::vector<Copy>;

/// `tolerance`: how far a copy's surface may be from the group's first one, in the mesh's units. Each island
/// is in one group at most. Islands of few faces are no copies, nor are cavities.
std::vector<CopyGroup> find_copies(const PreparedMesh& prepared, double tolerance, const Task& task);

}  // namespace pfgeom
