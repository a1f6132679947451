#include "pfgeom/fit/quadric.h"

#include "pfgeom/fit/moments.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Fixes the scale; more would pull ellipsoids, whose gradients are not of one length, towards spheres.
constexpr double kNormalWeight = 1e-5;

// Positive inside and definite: the zero set is an ellipsoid (Sylvester's criterion on the negated matrix).
bool is_ellipsoid(const Quadric& q) {
    const double a = -q.c[0], b = -q.c[1], c = -q.c[2], d = -q.c[3] / 2, e = -q.c[4] / 2, f = -q.c[5] / 2;
    const double minor2 = a * b - d * d;
    const double minor3 = a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e);
    return a > 1e-9 && minor2 > 1e-12 && minor3 > 1e-15;
}

}  // namespace

Quadric scaled_and_rounded(Quadric q, std::span<const Vec3> points, double step) {
    double length = 0;
    for (const Vec3& p : points) length += norm(q.gradient(p)) / static_cast<double>(points.size());
    for (double& c : q.c) c = std::floor(c / length / step + 0.5) * step;
    return q;
}

double first_order_distance(const Quadric& q, const Vec3& p) {
    return std::abs(q.value(p)) / std::max(norm(q.gradient(p)), 1e-6);
}

std::optional<QuadricFit> fit_quadric(const FitTarget& target, double step) {
    Moments moments;
    for (std::size_t i = 0; i < target.points.size(); ++i)
        moments.add(target.points[i], target.normals[i], 1);
    const Quadric raw = moments.solve(kNormalWeight);
    if (!std::all_of(raw.c.begin(), raw.c.end(), [](double c) { return std::isfinite(c); })) return {};
    if (!is_ellipsoid(raw)) return {};
    QuadricFit fit{scaled_and_rounded(raw, target.points, step)};
    if (!is_ellipsoid(fit.quadric)) return {};
    double sum = 0;
    for (const Vec3& p : target.points) {
        const double e = first_order_distance(fit.quadric, p);
        sum += e * e;
        fit.max = std::max(fit.max, e);
    }
    fit.rms = std::sqrt(sum / static_cast<double>(target.points.size()));
    return fit;
}

}  // namespace pfgeom
