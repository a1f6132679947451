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

/// Well-formed UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
bool is_utf8(std::string_view text);

}  // namespace pfgeom
