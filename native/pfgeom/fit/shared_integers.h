// Quadrics of a part that share integers: equal radii, parallel planes, the same place in one direction,
// mirrored parts. A quadric is written after an earlier one of its family for about a bit for each integer
// that is the same but for its sign (codec/tree_quadric_codec.h), and tolerances leave room to make it so.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/tree_quadric.h"
#include "pfgeom/fit/whole_checks.h"

#include <cstddef>
#include <vector>

namespace pfgeom {

/// Changes quadrics[r] to what passes checks[r] and shares integers with another one, where that saves bits;
/// their `bits` are then what it takes to write them after it. `tries`: so many orders, of which the best is
/// taken.
void share_integers(const std::vector<RegionChecks>& checks, int resolution, double normal_weight,
                    std::size_t tries, std::vector<QuantisedQuadric>& quadrics, const Task& task = {});

}  // namespace pfgeom
