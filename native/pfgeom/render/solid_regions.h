// A set expression as a union of regions, each of which is where some functions have certain signs.
#pragma once

#include "pfgeom/function/model.h"
#include "pfgeom/render/condition.h"

#include <span>
#include <vector>

namespace pfgeom {

/// Their union holds the points that the expression has inside (or outside), and may hold others where there
/// would be too many regions. `regions` is overwritten.
void regions_of(std::span<const SetNode> nodes, bool inside, std::vector<SignRegion>& regions);

}  // namespace pfgeom
