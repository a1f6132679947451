// A model's combination as the content of a section (docs/FORMAT.md, section 10): a stream of its own.
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/function/combination.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// Throws InvalidInput where a promise does not fit its code.
std::vector<std::uint8_t> write_combination(const Combination& combination);

/// Fills `combination`; whether it makes sense is left to find_flaw.
FormatStatus read_combination(std::span<const std::uint8_t> content, Combination& combination);

}  // namespace pfgeom
