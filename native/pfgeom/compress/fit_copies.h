// Islands that are copies of one another as one object: the pattern is fitted once, in the pose that it was
// drawn in, and every copy is proved on the bytes.
#pragma once

#include "pfgeom/compress/candidate.h"
#include "pfgeom/segment/copies.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pfgeom {

struct FittedCopies {
    std::vector<std::size_t> islands;  ///< those that hold, in the order of the object's placements
    /// Its mesh is that of all copies one after the other; its deviation and bound are the largest of theirs.
    Outcome outcome;
};

/// What every island shall hold.
struct CopiesGoal {
    const PreparedMesh& prepared;
    double tolerance = 0;
    Metric metric = Metric::max;
    Effort effort = Effort::normal;
    bool painted = false;
};

/// Nothing if the islands take fewer bytes one by one.
std::optional<FittedCopies> fit_copies(const CopyGroup& group, const CopiesGoal& goal, const Task& task);

}  // namespace pfgeom
