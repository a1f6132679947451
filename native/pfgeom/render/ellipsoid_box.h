// How far an ellipsoid reaches.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/function/quadric.h"

#include <optional>

namespace pfgeom {

/// A box that holds all points with q >= 0, if they are an ellipsoid that is not nearly flat or endless.
std::optional<Box> ellipsoid_box(const Quadric& q);

}  // namespace pfgeom
