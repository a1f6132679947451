// The sections of a file: what a model carries beside its objects (docs/FORMAT.md, sections 9 and 10).
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/codec/header.h"
#include "pfgeom/function/model.h"

#include <vector>

namespace pfgeom {

/// Those that `model` has something for, by rising id.
std::vector<Section> write_sections(const Model& model);

/// Fills the model's members that sections hold. `memory`: bytes that they may take.
FormatStatus read_sections(const Envelope& envelope, std::size_t memory, Model& model);

}  // namespace pfgeom
