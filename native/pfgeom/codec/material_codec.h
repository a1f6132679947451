// The materials of a model, as a section of their own: names, then for each object its decision trees
// (docs/FORMAT.md, section 9).
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

std::vector<std::uint8_t> write_materials(const Model& model);

/// Fills model.materials; the rest of the model is read already. `memory`: bytes that they may take.
FormatStatus read_materials(std::span<const std::uint8_t> content, std::size_t memory, Model& model);

}  // namespace pfgeom
