// Small things that the candidates share.
#pragma once

#include "pfgeom/compress/candidate.h"

namespace pfgeom {

/// The code that stores a chord tolerance no larger than `chord`.
std::uint8_t mesh_code_for(const Goal& goal, double chord);

/// A power of two that a single quadric's coefficients are rounded to: near a sixteenth of the tolerance, so
/// that ten roundings together stay well below it.
double rounding_step(double tolerance);

/// The solid of function 0, or its complement.
Solid single_function(bool inward);

}  // namespace pfgeom
