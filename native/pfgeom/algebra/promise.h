// What is known of a combination from what its operands promise.
#pragma once

#include "pfgeom/function/model.h"

namespace pfgeom {

/// Of the image of one model: its own bounds, times what lengths grow by. Of set operations `bound_functions`
/// alone: each point of the result's surface is that close to the surface of what an operand was made from,
/// and each point further than that from all of these is inside or outside as it should be (docs/DESIGN.md).
/// 0 if that of an operand is not known.
Promise promise_of(const Combination& combination, const std::vector<CombinationNode>& tree);

}  // namespace pfgeom
