// What a region remembers of its surface: sums of powers of its points and of its normals. A quadric is
// solved from them without touching a point again, and the sums of two regions are the sums of their union.
// Source: the paper's section "Method" (systems solved from the leaves to the root, the parent's from the
// children's). Departure: least squares with normals instead of nine points; of the 110 different entries of
// the two ten by ten systems only 35 sums of powers and 12 of normals differ.
#pragma once

#include "pfgeom/base/cholesky.h"
#include "pfgeom/function/quadric.h"

#include <array>

namespace pfgeom {

/// How a quadric fits the surface that was summed.
struct FitQuality {
    double rms = 0;           ///< of the value, in units of the mean gradient: a distance
    double misalignment = 0;  ///< mean of |∇q + n|²
};

/// What least squares over the points of a surface need, with m = (x², y², z², xy, xz, yz, x, y, z, 1).
struct QuadricSystem {
    Matrix10 values{};     ///< mean of m mᵀ
    Matrix10 gradients{};  ///< mean of ∇m ∇mᵀ
    Vector10 inwards{};    ///< mean of -∇m·n

    /// argmin of the mean of q² + normal_weight |∇q + n|² over q = c·m. Directions that the points do not
    /// determine stay near zero. normal_weight is an area: differences of normals count like distances of its
    /// square root times the difference.
    Quadric solve(double normal_weight) const;
    /// The quadric with the least mean of q² for its size, and with the normals' sense: exact if the points
    /// lie on one quadric only.
    Quadric through_points() const;
    FitQuality quality(const Quadric& q) const;
};

class PowerSums {
  public:
    /// `normal` points outwards, where the quadric falls.
    void add(const Vec3& point, const Vec3& normal, double weight);
    /// The triangle, its area times `weight`, with quadrature nodes in its corners, edge middles and
    /// centroid: exact for cubics. Seven points see the triangle's sagitta as well as its corners.
    void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double weight = 1);
    PowerSums& operator+=(const PowerSums& other);
    PowerSums& operator*=(double factor);

    double weight() const { return powers_[0]; }
    Vec3 centroid() const { return Vec3{powers_[1], powers_[2], powers_[3]} / weight(); }
    QuadricSystem system() const;

  private:
    std::array<double, 35> powers_{};  // Σ w x^i y^j z^k, i + j + k <= 4, the lowest degrees first
    std::array<std::array<double, 4>, 3> normals_{};  // Σ w n_d (1, x, y, z)
};

}  // namespace pfgeom
