// Three rows of a list of vertices, counter-clockwise seen from outside.
#pragma once

#include <array>
#include <cstdint>

namespace pfgeom {

using Triangle = std::array<std::int32_t, 3>;

}  // namespace pfgeom
