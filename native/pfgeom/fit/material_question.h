// The question to ask in a cell of a material tree.
#pragma once

#include "pfgeom/fit/material_tree.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pfgeom {

/// What of a material tree's samples, and of its borders, lies in a cell.
struct MaterialCell {
    Box box;
    std::vector<std::uint32_t> samples, borders;  ///< rows
};

/// The plane that takes the samples of different materials apart best for its bits; nothing if none takes any
/// apart. Only forced samples count.
std::optional<MaterialNode> find_material_question(const MaterialCell& cell,
                                                   std::span<const MaterialSample> samples,
                                                   std::span<const BorderPiece> borders,
                                                   const MaterialFit& options);

}  // namespace pfgeom
