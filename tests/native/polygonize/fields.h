// Scalar fields with known zero sets, and random ones, for the tests of the polygonizer. Their ranges come
// from Lipschitz bounds, so they are conservative and as loose as real ones.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/eval/scalar_field.h"

#include <functional>
#include <vector>

namespace pfgeom::test {

/// Adds a Lipschitz range and central differences to a formula.
class FormulaField : public ScalarField {
  public:
    FormulaField(std::function<double(const Vec3&)> formula, double lipschitz)
        : formula_(std::move(formula)), lipschitz_(lipschitz) {}

    double value(const Vec3& p) const override { return formula_(p); }
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override {
        constexpr double kStep = 1e-6;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 low = p, high = p;
            low[axis] -= kStep;
            high[axis] += kStep;
            gradient[axis] = (formula_(high) - formula_(low)) / (2 * kStep);
        }
        return formula_(p);
    }
    Interval range(const Box& box) const override {
        const double middle = formula_(box.centre()), slack = lipschitz_ * box.diagonal() / 2 + 1e-12;
        return {middle - slack, middle + slack};
    }

  private:
    std::function<double(const Vec3&)> formula_;
    double lipschitz_;
};

inline FormulaField sphere_field(double radius, Vec3 centre = {}) {
    return {[=](const Vec3& p) { return radius - norm(p - centre); }, 1};
}

inline FormulaField torus_field(double major, double minor) {
    return {[=](const Vec3& p) {
                const double from_axis = std::sqrt(p.x * p.x + p.y * p.y) - major;
                return minor - std::sqrt(from_axis * from_axis + p.z * p.z);
            },
            1};
}

/// Not a distance: the gradient's length varies over the surface by the ratio of the axes.
inline FormulaField ellipsoid_field(Vec3 axes) {
    return {[=](const Vec3& p) {
                const Vec3 q = {p.x / axes.x, p.y / axes.y, p.z / axes.z};
                return 1 - squared_norm(q);
            },
            2 * std::sqrt(3.0) / std::min({axes.x, axes.y, axes.z}) / std::min({axes.x, axes.y, axes.z})};
}

inline FormulaField two_spheres_field(double gap) {
    return {[=](const Vec3& p) {
                const double x = std::abs(p.x) - 0.4 - gap / 2;
                return 0.4 - std::sqrt(x * x + p.y * p.y + p.z * p.z);
            },
            1};
}

inline FormulaField shell_field(double radius, double thickness) {
    return {[=](const Vec3& p) { return thickness / 2 - std::abs(norm(p) - radius); }, 1};
}

/// High genus: the thickened edges of a cubic lattice (a polynomial stand-in for a gyroid's waves).
inline FormulaField lattice_field(double period, double radius) {
    return {[=](const Vec3& p) {
                const auto fold = [=](double x) {
                    return std::abs(x / period - std::floor(x / period) - 0.5) * period;
                };
                const Vec3 q = {fold(p.x), fold(p.y), fold(p.z)};
                const double a = q.x * q.x, b = q.y * q.y, c = q.z * q.z;
                return radius - std::sqrt(std::min({a + b, b + c, c + a}));
            },
            1};
}

/// A sum of compact bumps f (1 - |x-c|²/r²)³ minus a level: smooth, with many components and handles.
class BumpField : public ScalarField {
  public:
    BumpField(std::uint64_t seed, int bumps, double smallest, double largest, double level) : level_(level) {
        Random random(seed);
        const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
        for (int i = 0; i < bumps; ++i)
            bumps_.push_back({{between(-1, 1), between(-1, 1), between(-1, 1)},
                              between(smallest, largest),
                              between(-1, 1)});
    }
    double value(const Vec3& p) const override {
        Vec3 gradient;
        return value_and_gradient(p, gradient);
    }
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override {
        double sum = level_;
        gradient = {};
        for (const Bump& b : bumps_) {
            const Vec3 d = p - b.centre;
            const double q = 1 - squared_norm(d) / (b.radius * b.radius);
            if (q <= 0) continue;
            sum += b.factor * q * q * q;
            gradient += d * (-6 * b.factor * q * q / (b.radius * b.radius));
        }
        return sum;
    }
    Interval range(const Box& box) const override {
        Interval sum{level_ - 1e-12, level_ + 1e-12};
        for (const Bump& b : bumps_) {
            const Vec3 far = max(b.centre - box.lo, box.hi - b.centre);
            const double near_q = 1 - box.squared_distance(b.centre) / (b.radius * b.radius);
            const double far_q = std::max(0.0, 1 - squared_norm(far) / (b.radius * b.radius));
            if (near_q <= 0) continue;
            const double x = b.factor * near_q * near_q * near_q, y = b.factor * far_q * far_q * far_q;
            sum.lo += std::min(x, y);
            sum.hi += std::max(x, y);
        }
        return sum;
    }

  private:
    struct Bump {
        Vec3 centre;
        double radius, factor;
    };
    double level_;
    std::vector<Bump> bumps_;
};

/// Signs at random: a field of small integers, constant in cells of a grid, and exactly 0 in many of them.
/// Not continuous, with no gradient anywhere; its range says nothing.
class NoiseField : public ScalarField {
  public:
    NoiseField(std::uint64_t seed, double cells) : seed_(seed), cells_(cells) {}
    double value(const Vec3& p) const override {
        const auto at = [this](double x) { return static_cast<std::uint64_t>((x + 2) * cells_ + 0.5); };
        return static_cast<double>(Random(seed_ ^ at(p.x) << 40 ^ at(p.y) << 20 ^ at(p.z)).below(5)) - 3;
    }
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override {
        gradient = {};
        return value(p);
    }
    Interval range(const Box&) const override { return {-3, 2}; }

  private:
    std::uint64_t seed_;
    double cells_;
};

}  // namespace pfgeom::test
