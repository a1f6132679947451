#include "pfgeom/fit/simplest_quadric.h"

#include "pfgeom/fit/moments.h"
#include "pfgeom/fit/quadric.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace pfgeom {
namespace {

// Of normals against distances. Where points alone leave several quadrics (all that vanish on two circles of
// a tube), normals decide; a small weight does not pull quadrics whose gradients differ in length.
constexpr double kNormalWeight = 1e-5;

double largest_distance(const Quadric& q, std::span<const Vec3> points) {
    double most = 0;
    for (const Vec3& p : points) most = std::max(most, first_order_distance(q, p));
    return most;
}

// Falls along the directions.
Quadric plane_of(const QuadricSamples& samples) {
    Vec3 normal = normalized(samples.loops), centre;
    double weight = 0, along = 0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        centre += samples.points[i] * samples.weights[i];
        weight += samples.weights[i];
        along += samples.weights[i] * dot(normal, samples.directions[i]);
    }
    if (along < 0) normal = -normal;
    return {{0, 0, 0, 0, 0, 0, -normal.x, -normal.y, -normal.z, dot(normal, centre) / weight}};
}

}  // namespace

std::optional<Quadric> simplest_quadric(const QuadricSamples& samples, double tolerance, double step) {
    if (samples.points.empty()) return {};
    if (norm(samples.loops) > 0) {
        const Quadric plane = scaled_and_rounded(plane_of(samples), samples.points, step);
        if (largest_distance(plane, samples.points) <= tolerance) return plane;
    }
    Moments moments;
    for (std::size_t i = 0; i < samples.points.size(); ++i)
        moments.add(samples.points[i], samples.directions[i], samples.weights[i]);
    const Quadric raw = moments.solve(kNormalWeight);
    if (!std::ranges::all_of(raw.c, [](double c) { return std::isfinite(c); })) return {};
    const Quadric rounded = scaled_and_rounded(raw, samples.points, step);
    if (!(largest_distance(rounded, samples.points) <= tolerance)) return {};
    return rounded;
}

}  // namespace pfgeom
