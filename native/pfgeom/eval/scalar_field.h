// What polygonizers, renderers and queries are written against: a scalar field, inside where it is >= 0.
#pragma once

#include "pfgeom/base/box.h"

#include <cmath>
#include <memory>
#include <span>

namespace pfgeom {

/// A plane near a field F over a box around c: |F(x) - value - gradient·(x - c)| <= error.
struct Tangent {
    double value = 0;
    Vec3 gradient;
    double error = 0;

    /// What F can be in a box within that box, given by its centre's offset from c and its half extent.
    Interval over(const Vec3& offset, const Vec3& half) const {
        const double middle = value + dot(gradient, offset);
        const double reach =
            (std::abs(gradient.x) * half.x + std::abs(gradient.y) * half.y + std::abs(gradient.z) * half.z) +
            error;
        return {middle - reach, middle + reach};
    }
};

/// Immutable and safe to use from many threads. Values at points come from one formula in one order, so every
/// implementation path gives the same bits (but for the sign of a zero).
class ScalarField {
  public:
    virtual ~ScalarField() = default;
    virtual double value(const Vec3& p) const = 0;
    /// The value; the gradient goes into `gradient`.
    virtual double value_and_gradient(const Vec3& p, Vec3& gradient) const = 0;
    /// Conservative: contains the value of every point of the box.
    virtual Interval range(const Box& box) const = 0;
    virtual Tangent tangent(const Box& box) const {
        const Interval all = range(box);
        return {(all.lo + all.hi) / 2, {}, (all.hi - all.lo) / 2};
    }
    /// The same field, bit for bit, that is evaluated sooner within the box; null where nothing is known that
    /// helps. This one must outlive it.
    virtual std::unique_ptr<const ScalarField> pruned(const Box& /*box*/) const { return nullptr; }
    /// values[i] = value(points[i]).
    virtual void values(std::span<const Vec3> points, std::span<double> values) const {
        for (std::size_t i = 0; i < points.size(); ++i) values[i] = value(points[i]);
    }
    /// The same with the gradients.
    virtual void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                                      std::span<Vec3> gradients) const {
        for (std::size_t i = 0; i < points.size(); ++i)
            values[i] = value_and_gradient(points[i], gradients[i]);
    }
    /// tangents[i] = tangent(boxes[i]).
    virtual void tangents(std::span<const Box> boxes, std::span<Tangent> tangents) const {
        for (std::size_t i = 0; i < boxes.size(); ++i) tangents[i] = tangent(boxes[i]);
    }
};

}  // namespace pfgeom
