// Elementary functions with the same bits on every machine: libm's differ from version to version.
#pragma once

namespace pfgeom {

/// Base-2 logarithm of x > 0, finite; error below 1e-14.
double reproducible_log2(double x);

}  // namespace pfgeom
