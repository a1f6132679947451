// A scalar field closed at the faces of the cube [-1,1]³: min(field, distance to the cube's faces).
#pragma once

#include "pfgeom/eval/scalar_field.h"
#include "pfgeom/polygonize/lattice.h"

#include <limits>

namespace pfgeom {

class CubeField {
  public:
    CubeField(const ScalarField& field, int max_depth)
        : field_(field), side_(std::int32_t{1} << max_depth), step_(2.0 / side_) {}

    std::int32_t side() const { return side_; }  ///< of the cube, in steps of the lattice
    double step() const { return step_; }
    Vec3 position(const LatticePoint& p) const {
        return {p[0] * step_ - 1, p[1] * step_ - 1, p[2] * step_ - 1};
    }
    bool on_cube(const LatticePoint& p) const {
        for (const std::int32_t c : p)
            if (c == 0 || c == side_) return true;
        return false;
    }

    double value(const Vec3& p) const { return closed(p, field_.value(p)); }
    double value(const LatticePoint& p) const { return lattice_value(p, value(position(p))); }
    double value_and_gradient(const Vec3& p, Vec3& gradient) const {
        return closed(p, field_.value_and_gradient(p, gradient), gradient);
    }
    double value_and_gradient(const LatticePoint& p, Vec3& gradient) const {
        return lattice_value(p, value_and_gradient(position(p), gradient));
    }
    /// The same of many points, sooner.
    void values(std::span<const Vec3> points, std::span<double> values) const {
        field_.values(points, values);
        for (std::size_t i = 0; i < points.size(); ++i) values[i] = closed(points[i], values[i]);
    }
    void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                              std::span<Vec3> gradients) const {
        field_.values_and_gradients(points, values, gradients);
        for (std::size_t i = 0; i < points.size(); ++i)
            values[i] = closed(points[i], values[i], gradients[i]);
    }
    /// A lattice point's value, given that of its position: points on the cube are outside, so that no
    /// surface leaves it.
    double lattice_value(const LatticePoint& p, double v) const {
        return v >= 0 && on_cube(p) ? -std::numeric_limits<double>::min() : v;
    }
    Box box(const LatticePoint& low, std::int32_t size) const {
        return {position(low), position(cube_corner(low, size, 7))};
    }
    void tangents(std::span<const Box> boxes, std::span<Tangent> tangents) const {
        field_.tangents(boxes, tangents);
    }
    std::unique_ptr<const ScalarField> pruned(const LatticePoint& low, std::int32_t size) const {
        return field_.pruned(box(low, size));
    }
    /// Can the cell hold a zero?
    bool may_cross(const LatticePoint& low, std::int32_t size) const {
        return may_cross(low, size, field_.range(box(low, size)));
    }
    /// The same for a known range. A cell that touches the cube's faces cannot be inside altogether.
    bool may_cross(const LatticePoint& low, std::int32_t size, const Interval& range) const {
        const LatticePoint high = cube_corner(low, size, 7);
        const bool wholly_inside = range.lo >= 0 && !on_cube(low) && !on_cube(high);
        return !(wholly_inside || range.hi < 0);
    }

  private:
    static double to_faces(const Vec3& p) {
        return 1 - std::max(std::max(std::abs(p.x), std::abs(p.y)), std::abs(p.z));
    }
    static double guarded(double v) { return v == v ? v : -1.0; }  // not a number counts as outside
    // Of a point with its value in the field.
    static double closed(const Vec3& p, double inner) { return guarded(std::min(inner, to_faces(p))); }
    static double closed(const Vec3& p, double inner, Vec3& gradient) {
        const double faces = to_faces(p);
        if (!(faces < inner)) return guarded(inner);
        gradient = {};
        for (int axis = 0; axis < 3; ++axis)
            if (faces == 1 - std::abs(p[axis])) {
                gradient[axis] = p[axis] < 0 ? 1 : -1;
                break;
            }
        return faces;
    }

    const ScalarField& field_;
    std::int32_t side_;
    double step_;
};

}  // namespace pfgeom
