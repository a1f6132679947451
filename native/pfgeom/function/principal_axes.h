// Eigenvectors of symmetric 3 × 3 matrices.
#pragma once

#include "pfgeom/base/vec.h"

#include <array>

namespace pfgeom {

struct PrincipalAxes {
    std::array<Vec3, 3> axes;      ///< orthonormal, right-handed
    std::array<double, 3> values;  ///< eigenvalues, in no particular order
};

/// Of the matrix with these rows; only what stands on and above the diagonal is read.
PrincipalAxes principal_axes(const std::array<Vec3, 3>& rows);

}  // namespace pfgeom
