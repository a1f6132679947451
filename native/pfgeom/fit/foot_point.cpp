#include "pfgeom/fit/foot_point.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Steps after the first: where bulges are a tenth of the edges two leave an error of a few 1e-4 of a
// distance.
constexpr int kSteps = 2;
// A step that moves the weights by less is the last.
constexpr double kSettled = 1e-3;

}  // namespace

// Ericson, "Real-time collision detection", 2005, section 5.1.5.
Vec3 closest_weights(const Vec3& p, const std::array<Vec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
                 d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const auto share = [](double x, double y) { return x + y > 0 ? std::clamp(x / (x + y), 0.0, 1.0) : 0.0; };
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double t = share(d1, -d3);
        return {1 - t, t, 0};
    }
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double t = share(d2, -d6);
        return {1 - t, 0, t};
    }
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        const double t = share(d4 - d3, d5 - d6);
        return {0, 1 - t, t};
    }
    const double sum = va + vb + vc;
    if (!(sum > 0)) return {1, 0, 0};  // no area
    const double v = vb / sum, w = vc / sum;
    return {1 - v - w, v, w};
}

FootPoint foot_point(const Vec3& p, const CurvedTriangle& triangle, const Vec3& start, double good_enough) {
    Vec3 w = start;
    FootPoint best{w, triangle.at(w), 0};
    best.squared = squared_norm(p - best.point);
    if (triangle.flat()) return best;
    for (int i = 0; i < kSteps && best.squared > good_enough; ++i) {
        const Vec3 next = closest_weights(p, triangle.tangent(w));
        const Vec3 point = triangle.at(next);
        const double squared = squared_norm(p - point), moved = squared_norm(next - w);
        w = next;
        if (squared < best.squared) best = {w, point, squared};
        if (moved < kSettled * kSettled) break;
    }
    return best;
}

FootPoint foot_point(const Vec3& p, const CurvedTriangle& triangle) {
    return foot_point(p, triangle, closest_weights(p, triangle.corners), -1);
}

}  // namespace pfgeom
