// The optional sections of a file: what a model carries beside its geometry (docs/FORMAT.md, section 9).
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/codec/header.h"
#include "pfgeom/function/model.h"

#include <vector>

namespace pfgeom {

/// Those that `model` has something for, by rising id.
std::vector<Section> write_sections(const Model& model);

/// Fills the model's optional members. `memory`: bytes that they may take.
FormatStatus read_sections(const Envelope& envelope, std::size_t memory, Model& model);

}  // namespace pfgeom
