// Mending: a fitted tree grows where the certificate finds it wrong, until nothing is found.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/compress/tree_target.h"
#include "pfgeom/fit/set_tree.h"

#include <span>

namespace pfgeom {

struct TreeCandidate {
    TreeFit fit;
    TreeFitOptions options;  ///< of the fit; their tolerance is a little less than what is certified
    double proved = 0;       ///< in the cube's units; 0: not certified
};

/// Certifies the trees, side by side, and sets `proved`, at most `certified`. Those that do not come to that
/// stay at 0, and so do those that grow beyond `most_bits` or beyond one that is certified.
void mend_trees(std::span<TreeCandidate> trees, const TreeTarget& target, double certified, double most_bits,
                const Task& task);

}  // namespace pfgeom
