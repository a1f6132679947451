// Points onto the zero set by Newton steps along the gradient.
#pragma once

#include "pfgeom/eval/function_field.h"
#include "pfgeom/polygonize/cube_field.h"

namespace pfgeom {

struct SurfacePoint {
    Vec3 position;
    Vec3 normal;  ///< unit, towards the outside (against the gradient)
};

/// Moves `start` onto the zero set, to within about `accuracy` where the field's gradient turns or grows by
/// less than itself over `size`. False if that leads further than `size` away or does not converge (`result`
/// is then not to be used).
bool project(const CubeField& field, const Vec3& start, double size, double accuracy, SurfacePoint& result);
/// The same, given the field at the start.
bool project(const CubeField& field, const Vec3& start, const Jet& at_start, double size, double accuracy,
             SurfacePoint& result);

/// A zero between two points of different sign, by bisection: always finds one.
SurfacePoint bisect(const CubeField& field, Vec3 inside, Vec3 outside);

}  // namespace pfgeom
