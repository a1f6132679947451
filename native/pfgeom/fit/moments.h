// The inverse pass: sums over samples from which a quadric is solved without touching the samples again.
// Source: the paper's section "Method" (systems solved at each octree level, from the leaves to the root).
// Departure: ten coefficients by least squares with normals instead of nine points by Cramer's rule, which
// fails for quadrics through the origin and amplifies noise.
#pragma once

#include "pfgeom/function/quadric.h"

#include <array>

namespace pfgeom {

/// With m(p) = (x², y², z², xy, xz, yz, x, y, z, 1): Σ w m mᵀ, Σ w ∇m ∇mᵀ and Σ w ∇m·n. Additive.
class Moments {
  public:
    void add(const Vec3& point, const Vec3& normal, double weight);
    Moments& operator+=(const Moments& other);

    /// The same samples seen from the child's or parent's frame: x = scale · x' + shift for each coordinate.
    Moments in_frame(double scale, const Vec3& shift) const;

    /// argmin Σ w [ (q·m)² + normal_weight |∇(q·m) + n|² ]: one symmetric 10×10 system. n points outwards,
    /// where q falls. A rank-deficient system gives the solution of least norm.
    Quadric solve(double normal_weight) const;
    double weight() const { return weight_; }

  private:
    std::array<double, 55> values_{};     // upper triangle of Σ w m mᵀ
    std::array<double, 55> gradients_{};  // upper triangle of Σ w ∇m ∇mᵀ
    std::array<double, 10> normals_{};    // Σ w ∇m·n
    double weight_ = 0;
};

}  // namespace pfgeom
