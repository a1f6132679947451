// Garland and Heckbert's quadric error: squared distances to planes, summed.
#pragma once

#include "pfgeom/fit/collapse_mesh.h"
#include "pfgeom/fit/symmetric3.h"

#include <algorithm>
#include <vector>

namespace pfgeom {

/// Σ w (n·(x - origin) + d)² over planes. Those that are added up have one origin.
struct PlaneQuadric {
    Vec3 origin;
    Symmetric3 a;
    Vec3 b;
    double c = 0, weight = 0;

    void add(const Vec3& normal, const Vec3& point, double w) {
        const double d = -dot(normal, point - origin);
        a.add(normal, w);
        b += normal * (w * d);
        c += w * d * d;
        weight += w;
    }
    PlaneQuadric& operator+=(const PlaneQuadric& o) {
        a += o.a, b += o.b, c += o.c, weight += o.weight;
        return *this;
    }
    double operator()(const Vec3& at) const {
        const Vec3 x = at - origin;
        return std::max(dot(x, a * x) + 2 * dot(b, x) + c, 0.0);
    }
    /// Where it is least; along directions that it leaves open, as near to `middle` as possible.
    Vec3 least(const Vec3& middle) const {
        Symmetric3 system = a;
        system.add_diagonal(1e-3 * a.trace());
        return middle - system.solve(a * (middle - origin) + b);
    }
};

/// Of each vertex: the planes of its faces by twice their areas, and at borders planes that hold them.
std::vector<PlaneQuadric> plane_quadrics(const CollapseMesh& mesh);

}  // namespace pfgeom
