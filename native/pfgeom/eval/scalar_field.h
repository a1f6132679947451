// What polygonizers, renderers and queries are written against: a scalar field, inside where it is >= 0.
#pragma once

#include "pfgeom/base/box.h"

#include <span>

namespace pfgeom {

/// Immutable and safe to use from many threads. Values at points come from one formula in one order, so every
/// implementation path gives the same bits.
class ScalarField {
  public:
    virtual ~ScalarField() = default;
    virtual double value(const Vec3& p) const = 0;
    /// The value; the gradient goes into `gradient`.
    virtual double value_and_gradient(const Vec3& p, Vec3& gradient) const = 0;
    /// Conservative: contains the value of every point of the box.
    virtual Interval range(const Box& box) const = 0;
    /// values[i] = value(points[i]).
    virtual void values(std::span<const Vec3> points, std::span<double> values) const {
        for (std::size_t i = 0; i < points.size(); ++i) values[i] = value(points[i]);
    }
};

}  // namespace pfgeom
