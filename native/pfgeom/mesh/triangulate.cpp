// Ear clipping (Meisters, "Polygons have ears", 1975) in the plane of Newell's normal, seen along its largest
// component. Departures: only reflex corners are tested against an ear (a convex one can only be inside if a
// reflex one is); a polygon without an ear (not simple, or folded) loses its next corner all the same, so
// that every corner stays used and the time is bounded.
#include "pfgeom/mesh/triangulate.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pfgeom {
namespace {

using Point = std::array<double, 2>;

/// Twice the signed area of abc, > 0 if it turns left.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::vector<Point> project(const std::vector<Vec3>& vertices, std::span<const std::int32_t> corners) {
    Vec3 normal;
    const Vec3& origin = vertices[corners[0]];
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        normal += cross(vertices[corners[i]] - origin, vertices[corners[i + 1]] - origin);
    int drop = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(normal[axis]) > std::abs(normal[drop])) drop = axis;
    int u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(u, v);

    std::vector<Point> points;
    points.reserve(corners.size());
    for (const std::int32_t corner : corners) points.push_back({vertices[corner][u], vertices[corner][v]});
    return points;
}

class EarClipper {
  public:
    EarClipper(std::vector<Point> points, std::int64_t& budget)
        : points_(std::move(points)), budget_(budget) {
        const std::size_t n = points_.size();
        previous_.resize(n);
        next_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            previous_[i] = (i + n - 1) % n;
            next_[i] = (i + 1) % n;
        }
        for (std::size_t i = 0; i < n; ++i) {
            const double t = corner_turn(i);
            if (t < 0) reflex_.push_back(i);
            strictly_convex_ = strictly_convex_ && t > 0;
        }
    }

    /// A fan serves: no corner is reflex, and none straight (its triangle could have no area).
    bool strictly_convex() const { return strictly_convex_; }
    /// Whether the budget has room for one test of every corner, the usual cost.
    bool affordable() const {
        return static_cast<double>(points_.size()) * static_cast<double>(reflex_.size() + 1) <
               static_cast<double>(budget_);
    }

    /// Triangles as rows of the points.
    std::vector<std::array<std::size_t, 3>> clip() {
        std::vector<std::array<std::size_t, 3>> ears;
        std::size_t corner = 0, refused = 0, left = points_.size();
        while (left > 3) {
            if (refused < left && !is_ear(corner)) {
                ++refused;
                corner = next_[corner];
                continue;
            }
            ears.push_back({previous_[corner], corner, next_[corner]});
            corner = remove(corner);
            refused = 0;
            --left;
        }
        ears.push_back({previous_[corner], corner, next_[corner]});
        return ears;
    }

  private:
    double corner_turn(std::size_t i) const {
        return turn(points_[previous_[i]], points_[i], points_[next_[i]]);
    }

    bool is_ear(std::size_t i) {
        if (budget_ <= 0) return true;
        budget_ -= static_cast<std::int64_t>(reflex_.size() + 1);
        const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
        if (!(turn(a, b, c) > 0)) return false;
        for (const std::size_t r : reflex_) {
            const Point& p = points_[r];
            if (p == a || p == b || p == c) continue;  // the corners themselves, and bridges to holes
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    /// Takes corner i away; the next one to look at skips a corner, which keeps fans of slivers away.
    std::size_t remove(std::size_t i) {
        const std::size_t before = previous_[i], after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        std::erase_if(reflex_, [&](std::size_t r) {
            return r == i || ((r == before || r == after) && corner_turn(r) >= 0);
        });
        return next_[after];
    }

    std::vector<Point> points_;
    std::vector<std::size_t> previous_, next_;
    std::vector<std::size_t> reflex_;
    bool strictly_convex_ = true;
    std::int64_t& budget_;
};

std::vector<Triangle> fan(std::span<const std::int32_t> corners) {
    std::vector<Triangle> faces;
    for (std::size_t i = 2; i < corners.size(); ++i)
        faces.push_back({corners[0], corners[i - 1], corners[i]});
    return faces;
}

}  // namespace

std::vector<Triangle> triangulate_polygon(const std::vector<Vec3>& vertices,
                                          std::span<const std::int32_t> corners, std::int64_t& budget) {
    EarClipper clipper(project(vertices, corners), budget);
    if (clipper.strictly_convex() || !clipper.affordable()) return fan(corners);
    std::vector<Triangle> faces;
    for (const auto& [a, b, c] : clipper.clip()) faces.push_back({corners[a], corners[b], corners[c]});
    return faces;
}

}  // namespace pfgeom
