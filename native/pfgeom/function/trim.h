// What a sheet's surface is cut by, as a set expression.
#pragma once

#include "pfgeom/function/model.h"

#include <vector>

namespace pfgeom {

/// The sheet is the part of its surface that is inside.
struct Trim {
    std::vector<Function> functions;
    std::vector<SetNode> nodes;  ///< they name rows of `functions`; the root last
};
Trim trim_of(const Model& model, const Sheet& sheet);

/// The same nodes at the end of an expression that has these functions after `first` others.
void append_trim(const Trim& trim, std::int32_t first, std::vector<SetNode>& nodes);

}  // namespace pfgeom
