// Closest points: depth first, nearer boxes first, and nothing that is farther than the best so far.
//
// The answer is the least (squared distance, face) over all faces as computed, so neither the order of the
// visits nor the hint can change it: boxes are pruned with a slack far above what rounding can do.
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/bvh_stack.h"

namespace pfgeom {
namespace {

Vec3 closest_point_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double along = dot(p - a, ab), length = squared_norm(ab);
    if (!(along > 0)) return a;
    return along < length ? a + ab * (along / length) : b;
}

// Ericson's barycentric weights have an error of 1e-16 divided by this: here 1e-10 of the triangle's size.
constexpr double kThin = 1e-6;  // squared sine of the angle at a

// Needles and worse: coordinates along the longest edge, then from it, which keep 1e-15 of the triangle's
// size.
Vec3 closest_point_on_thin_triangle(const Vec3& p, Vec3 a, Vec3 b, Vec3 c) {
    for (int turn = 0; turn < 2; ++turn) {
        const double ab = squared_norm(b - a);
        if (ab >= squared_norm(c - b) && ab >= squared_norm(a - c)) break;
        const Vec3 first = a;
        a = b, b = c, c = first;
    }
    const Vec3 ab = b - a;
    const double length = squared_norm(ab);
    if (length > 0) {
        const double s = dot(p - a, ab) / length, s_c = dot(c - a, ab) / length;
        const Vec3 foot = a + ab * s, height = c - (a + ab * s_c);
        const double t = dot(p - foot, height) / squared_norm(height);  // NaN without height: then not inside
        if (t > 0 && t < 1 && s > s_c * t && 1 - s > (1 - s_c) * t) return foot + height * t;
    }
    Vec3 best = closest_point_on_segment(p, a, b);
    for (const Vec3& q : {closest_point_on_segment(p, b, c), closest_point_on_segment(p, c, a)}) {
        if (squared_norm(q - p) < squared_norm(best - p)) best = q;
    }
    return best;
}

std::array<double, 4> squared_distances(const BvhNode& node, const Vec3& p) {
    std::array<double, 4> sum{};
    for (int axis = 0; axis < 3; ++axis) {
        const double x = p[axis];
        for (int k = 0; k < 4; ++k) {
            const double d = std::max(std::max(node.lo[axis][k] - x, x - node.hi[axis][k]), 0.0);
            sum[k] += d * d;
        }
    }
    return sum;
}

}  // namespace

Vec3 closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Vec3 bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const Vec3 cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;

    const double abab = squared_norm(ab), acac = squared_norm(ac), abac = dot(ab, ac);
    if (!(abab * acac - abac * abac > kThin * abab * acac)) return closest_point_on_thin_triangle(p, a, b, c);

    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    const double d43 = d4 - d3, d56 = d5 - d6;
    if (va <= 0 && d43 >= 0 && d56 >= 0) return b + (c - b) * (d43 / (d43 + d56));
    const double scale = 1 / (va + vb + vc);
    return a + ab * (vb * scale) + ac * (vc * scale);
}

ClosestPoint Bvh::closest(const Vec3& p, double within, std::int32_t hint, double enough) const {
    ClosestPoint best;
    best.squared_distance = within * within;
    const double squared_enough = enough < 0 ? -1 : enough * enough;
    const auto will_do = [&] { return best.face >= 0 && best.squared_distance <= squared_enough; };
    const auto try_triangle = [&](std::int32_t i) {
        const Vec3* t = &corners_[3 * static_cast<std::size_t>(i)];
        const Vec3 q = closest_point_on_triangle(p, t[0], t[1], t[2]);
        const double d = squared_norm(q - p);
        if (d > best.squared_distance) return;
        // Of equal ones the lowest face; as unsigned numbers, "none" (-1) is the highest.
        if (d == best.squared_distance &&
            static_cast<std::uint32_t>(faces_[i]) >= static_cast<std::uint32_t>(best.face)) {
            return;
        }
        best = {faces_[i], q, d};
    };
    if (nodes_.empty()) return {};
    if (hint >= 0 && hint < static_cast<std::int32_t>(position_.size())) try_triangle(position_[hint]);
    if (will_do()) return best;

    // Rounding moves a distance d by some 1e-15 (d + size of the coordinates); its square by less than this.
    const double size = squared_norm(p) + squared_norm(max(bounds_.hi, -bounds_.lo));
    // Finite, so that unused children, whose boxes are infinitely far, stay out.
    const auto limit = [&] {
        return std::min(best.squared_distance * (1 + 1e-6) + 1e-22 * size,
                        std::numeric_limits<double>::max());
    };
    BvhStack stack;
    stack.push({0, 0, 0});
    while (!stack.empty()) {
        const BvhStack::Entry entry = stack.pop();
        if (entry.distance > limit()) continue;
        for (std::int32_t i = entry.first; i < entry.first + entry.count; ++i) try_triangle(i);
        if (will_do()) return best;
        if (entry.count > 0) continue;
        const BvhNode& node = nodes_[entry.first];
        stack.push_sorted(node, squared_distances(node, p), limit());
    }
    if (best.face < 0) return {};
    return best;
}

double Bvh::farthest_corner(const std::array<Vec3, 3>& triangle, std::int32_t face) const {
    const Vec3* t = &corners_[3 * static_cast<std::size_t>(position_[static_cast<std::size_t>(face)])];
    double worst = 0;
    for (const Vec3& p : triangle)
        worst = std::max(worst, squared_norm(closest_point_on_triangle(p, t[0], t[1], t[2]) - p));
    return std::sqrt(worst);
}

void Bvh::faces_within(const Vec3& p, double distance, std::vector<std::int32_t>& faces) const {
    if (nodes_.empty()) return;
    const double limit = std::min(distance * distance, std::numeric_limits<double>::max());
    BvhStack stack;
    stack.push({0, 0, 0});
    while (!stack.empty()) {
        const BvhStack::Entry entry = stack.pop();
        for (std::int32_t i = entry.first; i < entry.first + entry.count; ++i) {
            const Vec3* t = &corners_[3 * static_cast<std::size_t>(i)];
            if (squared_norm(closest_point_on_triangle(p, t[0], t[1], t[2]) - p) <= limit)
                faces.push_back(faces_[i]);
        }
        if (entry.count > 0) continue;
        const BvhNode& node = nodes_[entry.first];
        stack.push_sorted(node, squared_distances(node, p), limit);
    }
}

}  // namespace pfgeom
