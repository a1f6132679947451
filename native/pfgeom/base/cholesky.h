// Small symmetric positive definite systems: L D Lᵀ without pivoting, on arrays of fixed size, in an order
// that is written out. The systems of quadrics are ten by ten; a linear algebra library would only add its
// own order.
#pragma once

#include <array>
#include <cstddef>

namespace pfgeom {

using Vector10 = std::array<double, 10>;
using Matrix10 = std::array<std::array<double, 10>, 10>;

/// a = L D Lᵀ: D on the diagonal of the result, the unit lower triangle L below it. Only the first n rows and
/// the lower triangle of `a` are read. A pivot that is not positive makes its column zero.
inline Matrix10 factorise(const Matrix10& a, std::size_t n = 10) {
    Matrix10 f{};
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= f[i][k] * f[k][k] * f[j][k];
            f[i][j] = i == j ? sum : f[j][j] > 0 ? sum / f[j][j] : 0;
        }
    }
    return f;
}

/// Solves a x = b from the factors of a; components with a pivot that is not positive become zero.
inline Vector10 solve_factorised(const Matrix10& f, Vector10 b, std::size_t n = 10) {
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= f[i][k] * b[k];
    }
    for (std::size_t i = n; i-- > 0;) {
        b[i] = f[i][i] > 0 ? b[i] / f[i][i] : 0;
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= f[k][i] * b[k];
    }
    return b;
}

}  // namespace pfgeom
