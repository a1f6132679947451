#include "pfgeom/polygonize/edge_tests.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr double kFacing = 0.3;  // least cosine between a triangle and the normals at its corners
// Least height over longest side of the triangles that a merge may make. On igea at 1e-4, 0.2 and 0.25 take 3
// and 6 % more triangles, which are no better in the mean.
constexpr double kThinnest = 0.15;
constexpr int kMostNeighbours = 10;  // of a vertex after a merge

}  // namespace

bool EdgeTests::faces_outside(std::int32_t a, std::int32_t b, std::int32_t c, double thinnest,
                              double facing) const {
    const Vec3 ab = mesh_.position[b] - mesh_.position[a], ac = mesh_.position[c] - mesh_.position[a];
    const Vec3 n = cross(ab, ac);
    const double area = norm(n);
    const double side = std::max({squared_norm(ab), squared_norm(ac), squared_norm(ac - ab)});
    if (!(area > thinnest * side)) return false;
    for (const std::int32_t v : {a, b, c})
        if (dot(n, mesh_.normal[v]) < facing * area) return false;
    return true;
}

bool EdgeTests::may_merge(std::int32_t h, double limit) const {
    const std::int32_t b = mesh_.to(h);
    if (height(h) > limit) return false;
    int neighbours = mesh_.valence(mesh_.twin(h)) - 4;
    std::int32_t spoke = h;
    do {
        ++neighbours;
        const std::int32_t x = mesh_.to(spoke), y = mesh_.apex(spoke);
        if (x != b && height(b, x) > limit) return false;
        if (x != b && y != b && !faces_outside(b, x, y, kThinnest, kFacing)) return false;
        spoke = mesh_.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return neighbours <= kMostNeighbours;
}

bool EdgeTests::should_flip(std::int32_t h, double tolerance) const {
    const std::int32_t g = mesh_.twin(h);
    const std::int32_t a = mesh_.from(h), b = mesh_.to(h), c = mesh_.apex(h), d = mesh_.apex(g);
    const auto& p = mesh_.position;
    const Vec3 ca = p[a] - p[c], cb = p[b] - p[c], da = p[a] - p[d], db = p[b] - p[d];
    const double sine_c = norm(cross(ca, cb)), sine_d = norm(cross(da, db));
    const double opposite = dot(ca, cb) * sine_d + dot(da, db) * sine_c;
    const bool rounder = opposite < -1e-9 * (norm(ca) * norm(cb)) * (norm(da) * norm(db));
    const bool now_low = height(a, b) <= tolerance, then_low = height(c, d) <= tolerance;
    const bool lower = then_low && !now_low;
    if (!lower && !(rounder && then_low == now_low)) return false;
    const double thinnest = lower ? kThinnest : 0;
    if (!faces_outside(c, d, b, thinnest, kFacing) || !faces_outside(d, c, a, thinnest, kFacing))
        return false;
    return c != d && mesh_.valence(h) > 3 && mesh_.valence(g) > 3 &&
           !mesh_.joined(SurfaceMesh::previous(h), d);
}

}  // namespace pfgeom
