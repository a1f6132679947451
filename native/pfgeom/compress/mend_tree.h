// Mending: a fitted tree grows where the certificate finds it wrong, until nothing is found.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/compress/tree_target.h"
#include "pfgeom/fit/set_tree.h"

#include <optional>

namespace pfgeom {

/// What is proved of the tree in the end, at most `certified`, in the cube's units. Nothing: it does not come
/// to that, or the tree grows beyond `most_bits`. `options`: those of the fit, whose tolerance is a little
/// less than `certified`; mending adds to `held`.
std::optional<double> mend_tree(TreeFit& fit, TreeFitOptions& options, const TreeTarget& target,
                                double certified, double most_bits, const Task& task);

}  // namespace pfgeom
