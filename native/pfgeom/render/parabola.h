// A quadric along a ray.
#pragma once

#include "pfgeom/function/quadric.h"
#include "pfgeom/render/ray.h"

#include <array>
#include <cmath>
#include <utility>

namespace pfgeom {

/// Its value at parameter t: (a t + b) t + c.
struct Parabola {
    double a, b, c;

    Parabola(const Quadric& q, const Ray& ray) {
        const Vec3& d = ray.direction;
        const auto& k = q.c;
        a = (k[0] * d.x * d.x + k[1] * d.y * d.y + k[2] * d.z * d.z) +
            (k[3] * d.x * d.y + k[4] * d.x * d.z + k[5] * d.y * d.z);
        b = dot(q.gradient(ray.origin), d);
        c = q.value(ray.origin);
    }
    bool is_high(double t) const { return (a * t + b) * t + c >= 0; }

    /// How many, rising; a double root counts for none or two. No cancellation.
    int roots(std::array<double, 2>& t) const {
        const double discriminant = b * b - 4 * a * c;
        if (!(discriminant >= 0)) return 0;
        const double s = -(b + (b < 0 ? -1 : 1) * std::sqrt(discriminant)) / 2;
        std::size_t count = 0;
        if (a != 0) t[count++] = s / a;
        if (s != 0) t[count++] = c / s;
        if (count == 2 && t[0] > t[1]) std::swap(t[0], t[1]);
        return static_cast<int>(count);
    }
};

}  // namespace pfgeom
