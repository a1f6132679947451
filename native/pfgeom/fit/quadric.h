// One island as one quadric: the least case of the method.
#pragma once

#include "pfgeom/fit/target.h"
#include "pfgeom/function/quadric.h"

#include <optional>
#include <span>

namespace pfgeom {

struct QuadricFit {
    Quadric quadric;
    double max = 0, rms = 0;  ///< |Q| / |∇Q| at the samples, in the cube's units
};

/// q, its gradient of length one on average at the points, its coefficients multiples of `step`.
Quadric scaled_and_rounded(Quadric q, std::span<const Vec3> points, double step);

/// |q| / |∇q| at p.
double first_order_distance(const Quadric& q, const Vec3& p);

/// The quadric of least squares through the target's samples, its coefficients rounded to multiples of `step`
/// (their effect on the surface is about as large). Nothing if it is no ellipsoid inside the cube.
std::optional<QuadricFit> fit_quadric(const FitTarget& target, double step);

}  // namespace pfgeom
