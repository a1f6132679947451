// Distances of surfaces: not the fitters' own measure.
#pragma once

#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/sample.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfgeom::test {

/// Largest distance from samples and vertices of `from` to `to`.
inline double one_sided(const TriangleMesh& from, const TriangleMesh& to) {
    const Bvh bvh(to);
    double worst = 0;
    std::vector<Vec3> points = sample_surface(from, 20000, 1).points;
    for (const Triangle& t : from.faces) {
        for (const std::int32_t v : t) points.push_back(from.vertices[static_cast<std::size_t>(v)]);
    }
    for (const Vec3& p : points) worst = std::max(worst, bvh.closest(p).squared_distance);
    return std::sqrt(worst);
}

inline double two_sided(const TriangleMesh& a, const TriangleMesh& b) {
    return std::max(one_sided(a, b), one_sided(b, a));
}

}  // namespace pfgeom::test
