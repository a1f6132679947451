// The quadrics of one family that a region would have, one integer after the other. The successive rounding
// is Babai's nearest plane ("On Lovász' lattice reduction and the nearest lattice point problem",
// Combinatorica 6, 1986) with the region's own least squares as the norm.
#pragma once

#include "pfgeom/function/quadric_family.h"
#include "pfgeom/segment/power_sums.h"

#include <cstdint>

namespace pfgeom {

class FamilyRounding {
  public:
    FamilyRounding(std::uint8_t family, const QuadricSystem& region, double normal_weight);

    const QuadricFamily& family() const { return family_; }
    std::size_t size() const { return family_.size; }
    /// The coefficients that least squares want, at a mean gradient of one.
    const Vector10& best() const { return best_; }
    Quadric best_quadric() const;

    /// Is integer i the direction of an axis plane, which has no unit?
    bool is_direction(std::size_t i) const;
    /// The unit of integer i is 2^-exponent.
    int exponent(const TreeQuadric& units, std::size_t i, int resolution) const;
    /// Where least squares want coefficient i, at so many times the mean gradient, after the errors of those
    /// before it.
    double wanted(std::size_t i, double scale, const Vector10& error) const;
    /// Mean gradient near one, and against the normals.
    bool faces_inwards(const Quadric& quadric) const;

  private:
    Vector10 coefficients_of(const Quadric& quadric) const;

    const QuadricFamily& family_;
    Vector10 best_{};
    Matrix10 pull_{};  // by how much integer i answers to the error of each one before it
    Matrix10 gradients_{};
    Vector10 inwards_{};
};

}  // namespace pfgeom
