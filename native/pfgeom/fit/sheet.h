// One open island as one quadric cut by another: the least sheet.
#pragma once

#include "pfgeom/fit/target.h"
#include "pfgeom/function/quadric.h"

#include <optional>

namespace pfgeom {

/// The zero set of `surface` where `trim` is >= 0; faces look to where `surface` falls.
struct SheetFit {
    Quadric surface, trim;
};

/// `mesh`: an island with a border, in the cube of `target`, which has samples of it. Planes are preferred
/// for both. Coefficients are multiples of `step`. Nothing if no quadric comes within `tolerance` of the
/// samples.
std::optional<SheetFit> fit_sheet(const TriangleMesh& mesh, const FitTarget& target, double tolerance,
                                  double step);

}  // namespace pfgeom
