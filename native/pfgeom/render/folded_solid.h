// A set expression by the signs of its functions, and what is left of it where some of them are known.
#pragma once

#include "pfgeom/function/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

enum class KnownSign : std::int8_t { outside = -1, unknown = 0, inside = 1 };

/// The expression with the functions' known signs put in; signs[i] is that of the function with number i.
/// What does not matter to the root any more is gone. Known as a whole: one node, inside or outside.
std::vector<SetNode> fold(std::span<const SetNode> nodes, std::span<const KnownSign> signs);

/// Is a point with these signs (1: inside the function) inside? `scratch` is grown as needed.
bool is_inside(std::span<const SetNode> nodes, std::span<const std::uint8_t> signs,
               std::vector<std::uint8_t>& scratch);

}  // namespace pfgeom
