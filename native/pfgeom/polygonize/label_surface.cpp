#include "pfgeom/polygonize/label_surface.h"

namespace pfgeom {
namespace {

constexpr int kSteps = 8;  // of Newton; two are the rule

}  // namespace

// Newton's step for all the labels, by Gram and Schmidt: the shortest that solves the linearised equations.
Vec3 LabelSurface::step(std::span<const Label> labels, const Vec3& p, double least_sine) const {
    std::array<Vec3, 3> basis;
    std::size_t n = 0;
    Vec3 d;
    for (const Label label : labels) {
        const Vec3 gradient = quadric(label).gradient(p);
        const double slope = norm(gradient);
        const Vec3 g = gradient / slope;
        Vec3 u = g;
        for (std::size_t i = 0; i < n; ++i) u -= basis[i] * dot(u, basis[i]);
        const double sine = norm(u);
        if (!(sine > least_sine)) continue;
        u = u / sine;
        d -= u * ((quadric(label).value(p) / slope + dot(g, d)) / sine);
        basis[n++] = u;
        if (n == 3) break;
    }
    return d;
}

bool LabelSurface::project(std::span<const Label> labels, double reach, double accuracy, Vec3& p,
                           double least_sine) const {
    Vec3 at = p;
    for (int i = 0; i < kSteps; ++i) {
        const Vec3 d = step(labels, at, least_sine);
        at += d;
        if (!(squared_norm(at - p) <= reach * reach)) return false;
        if (squared_norm(d) > accuracy * accuracy) continue;
        p = at;
        return true;
    }
    return false;
}

}  // namespace pfgeom
