// Small things that the candidates share.
#pragma once

#include "pfgeom/compress/candidate.h"

namespace pfgeom {

/// The default mesh's chord tolerance in the world's units, and the code that stores one no larger than
/// `chord`.
double chord_of(const Model& model, const Object& object);
std::uint8_t mesh_code_for(const Goal& goal, double chord);

/// The solid of function 0, or its complement.
Solid single_function(bool inward);

}  // namespace pfgeom
