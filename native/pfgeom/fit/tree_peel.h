// Questions with one answer: all points on one side of a quadric are inside, or all are outside. A union of
// ellipsoids is a chain of such questions, so is a part with holes drilled through. Source: decision lists
// (Rivest, "Learning decision lists", Machine Learning 2, 1987).
#pragma once

#include "pfgeom/fit/tree_builder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// Of the quadrics not `asked`, the one whose side with one label holds most members; -1: none. It must tell
/// most of its own patch's points with that label from the rest.
std::int32_t peeled_quadric(const SampleTable& samples, std::span<const std::int32_t> members,
                            const std::vector<char>& asked);

}  // namespace pfgeom
