// Which models have an inside.
#pragma once

#include "pfgeom/function/model.h"

namespace pfgeom {

/// Throws InvalidInput, which names the object, if one is a sheet or a mesh part whose faces do not enclose
/// anything: with an edge that has not as many faces in one direction as in the other.
void require_closed(const Model& model);

}  // namespace pfgeom
