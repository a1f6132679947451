// The structural rules of a model: what every stage may rely on, checked before a model is written and after
// it was read.
#pragma once

#include "pfgeom/base/limits.h"
#include "pfgeom/function/model.h"

#include <string>

namespace pfgeom {

/// What is wrong, as a sentence that names the row; empty if nothing is. Linear in the size of the model.
std::string find_flaw(const Model& model, const Limits& limits = {});

/// The same for a tree: order and depth of its nodes, quadrics in the order of their first use and none asked
/// twice on a path, every integer within its range (function/set_tree_check.cpp).
std::string find_flaw(const SetTree& tree);

/// The same for a decision tree with that many materials, and for a model's materials alone
/// (function/material_check.cpp).
std::string find_flaw(const MaterialTree& tree, std::size_t materials);
std::string find_flaw_of_materials(const Model& model, const Limits& limits = {});

/// Of a promise, and of the diagonal that stands beside it.
std::string find_flaw(const Promise& promise, double diagonal);

/// Of the model's combination: operands that are all used, in order, and cover the objects; steps that leave
/// one result; transforms that can be inverted; no sheet in a set operation (function/combination.cpp).
std::string find_combination_flaw(const Model& model);

}  // namespace pfgeom
