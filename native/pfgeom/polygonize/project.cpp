#include "pfgeom/polygonize/project.h"

namespace pfgeom {
namespace {

constexpr int kSteps = 6;        // of Newton; two are the rule
constexpr int kBisections = 30;  // 2^-30 of a cell's edge

}  // namespace

bool project(const CubeField& field, const Vec3& start, double size, double accuracy, SurfacePoint& result) {
    Jet jet;
    jet.value = field.value_and_gradient(start, jet.gradient);
    return project(field, start, jet, size, accuracy, result);
}

bool project(const CubeField& field, const Vec3& start, const Jet& at_start, double size, double accuracy,
             SurfacePoint& result) {
    Vec3 p = start;
    auto [value, gradient] = at_start;
    for (int i = 0; i < kSteps; ++i) {
        if (i > 0) value = field.value_and_gradient(p, gradient);
        const double steepness = squared_norm(gradient);
        const Vec3 step = gradient * (value / steepness);
        p -= step;
        // Also false where the gradient vanishes or overflows: the step is then not a number.
        if (!(squared_norm(p - start) <= size * size)) return false;
        // After a step d the field is still off by half its second derivative times d²: no need to look.
        if (squared_norm(step) <= 2 * accuracy * size) {
            result = {p, gradient * (-1 / std::sqrt(steepness))};
            return is_finite(result.normal);
        }
    }
    return false;
}

SurfacePoint bisect(const CubeField& field, Vec3 inside, Vec3 outside) {
    for (int i = 0; i < kBisections; ++i) {
        const Vec3 middle = (inside + outside) * 0.5;
        (field.value(middle) >= 0 ? inside : outside) = middle;
    }
    Vec3 gradient;
    field.value_and_gradient(inside, gradient);
    Vec3 normal = normalized(-gradient);
    if (!is_finite(normal) || squared_norm(normal) < 0.5) normal = normalized(outside - inside);
    if (squared_norm(normal) < 0.5) normal = {0, 0, 1};
    return {inside, normal};
}

}  // namespace pfgeom
