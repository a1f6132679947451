// One island as one quadric: the least case of the method.
#pragma once

#include "pfgeom/fit/target.h"
#include "pfgeom/function/quadric.h"

#include <optional>

namespace pfgeom {

struct QuadricFit {
    Quadric quadric;
    double max = 0, rms = 0;  ///< |Q| / |∇Q| at the samples, in the cube's units
};

/// The quadric of least squares through the target's samples, its coefficients rounded to multiples of `step`
/// (their effect on the surface is about as large). Nothing if it is no ellipsoid inside the cube.
std::optional<QuadricFit> fit_quadric(const FitTarget& target, double step);

}  // namespace pfgeom
