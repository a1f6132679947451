// The operands of one or two models in one model.
#pragma once

#include "pfgeom/function/model.h"

namespace pfgeom {

/// Appends the model's steps to those of `all`, its operands as far as they are not there yet, and the
/// functions that these name. A model without a combination is one operand.
void append_operands(const Model& model, Model& all);

}  // namespace pfgeom
