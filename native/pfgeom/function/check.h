// The structural rules of a model: what every stage may rely on, checked before a model is written and after
// it was read.
#pragma once

#include "pfgeom/base/limits.h"
#include "pfgeom/function/model.h"

#include <string>
#include <string_view>

namespace pfgeom {

/// What is wrong, as a sentence that names the row; empty if nothing is. Linear in the size of the model.
std::string find_flaw(const Model& model, const Limits& limits = {});

/// The same for a tree: order and depth of its nodes, quadrics in the order of their first use and none asked
/// twice on a path, every integer within its range (function/set_tree_check.cpp).
std::string find_flaw(const SetTree& tree);

/// Of a promise, and of the diagonal that stands beside it.
std::string find_flaw(const Promise& promise, double diagonal);

/// Of the model's combination: operands that are all used, in order, and cover the objects; steps that leave
/// one result; transforms that can be inverted; no sheet in a set operation (function/combination.cpp).
std::string find_combination_flaw(const Model& model);

/// Well-formed UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
bool is_utf8(std::string_view text);

}  // namespace pfgeom
