// Axis-aligned box; empty until it has been grown.
#pragma once

#include "pfgeom/base/vec.h"

#include <limits>

namespace pfgeom {

struct Box {
    static constexpr double kInf = std::numeric_limits<double>::infinity();
    Vec3 lo{kInf, kInf, kInf}, hi{-kInf, -kInf, -kInf};

    bool empty() const { return lo.x > hi.x; }
    void grow(const Vec3& p) {
        lo = min(lo, p);
        hi = max(hi, p);
    }
    void grow(const Box& b) {
        lo = min(lo, b.lo);
        hi = max(hi, b.hi);
    }
    Vec3 centre() const { return (lo + hi) * 0.5; }
    Vec3 extent() const { return empty() ? Vec3{} : hi - lo; }
    double diagonal() const { return norm(extent()); }
    bool contains(const Vec3& p) const {
        return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
    }
    /// Squared distance from p to the box; 0 inside.
    double squared_distance(const Vec3& p) const { return squared_norm(max(max(lo - p, p - hi), Vec3{})); }
};

/// A closed range of values.
struct Interval {
    double lo = 0, hi = 0;
};

}  // namespace pfgeom
