// What a point of one side of a surface fulfils, in a cell: conditions on the signs of functions, and how a
// function looks from a point of the cell.
#pragma once

#include "pfgeom/base/vec.h"
#include "pfgeom/function/quadric.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pfgeom {

enum class Sense : std::int8_t { negative = -1, zero = 0, positive = 1 };

struct Condition {
    std::int32_t function = -1;  ///< in the numbering of the leaf
    Sense sense = Sense::positive;
};

/// Points where all conditions hold. Those beyond kMost are left out: the region is then too large, which
/// every user must be able to bear.
struct SignRegion {
    static constexpr std::size_t kMost = 8;
    std::array<Condition, kMost> conditions{};
    std::size_t count = 0;

    void add(const Condition& condition) {
        if (count < kMost) conditions[count++] = condition;
    }
};

/// Around a point x of a cell, for all points x + t of the cell:
/// value + gradient·t + ½ Σ lower_i t_i² <= F(x + t) <= value + gradient·t + ½ Σ upper_i t_i².
struct Expansion {
    double value = 0;
    Vec3 gradient, lower, upper;
};

/// Exact where the quadric has no products: |c t_i t_j| <= |c| (t_i² + t_j²) / 2. `bend`: of what is added to
/// it, a bound of the norm of the Hessian.
inline void set_curvature(const Quadric& q, double bend, Expansion& expansion) {
    const auto& c = q.c;
    const Vec3 square{2 * c[0], 2 * c[1], 2 * c[2]};
    const double xy = std::abs(c[3]), xz = std::abs(c[4]), yz = std::abs(c[5]);
    const Vec3 most{xy + xz + bend, xy + yz + bend, xz + yz + bend};
    expansion.lower = square - most;
    expansion.upper = square + most;
}

}  // namespace pfgeom
