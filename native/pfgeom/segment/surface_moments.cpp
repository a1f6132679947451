#include "pfgeom/segment/surface_moments.h"

#include "pfgeom/function/principal_axes.h"

#include <algorithm>

namespace pfgeom {
namespace {

// ∫ p pᵀ dA over a triangle = area / 12 (a aᵀ + b bᵀ + c cᵀ + s sᵀ), s = a + b + c.
void add_products(const Vec3& p, double weight, std::array<Vec3, 3>& rows) {
    for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(i)] += weight * p[i] * p;
}

}  // namespace

SurfaceMoments moments_of(const TriangleMesh& mesh) {
    SurfaceMoments m;
    if (mesh.faces.empty()) return m;
    // Near the surface, so that nothing cancels far from the origin.
    const Vec3 start = mesh.vertices[mesh.faces[0][0]];
    const auto corner = [&](const Triangle& t, std::size_t i) { return mesh.vertices[t[i]] - start; };
    for (const Triangle& t : mesh.faces) {
        const Vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
        const Vec3 normal = cross(b - a, c - a);
        const double area = norm(normal) / 2;
        m.area += area;
        m.centroid += area / 3 * (a + b + c);
        m.volume += dot(a, normal) / 6;
    }
    if (m.area == 0) return m;
    m.centroid = m.centroid / m.area;
    std::array<Vec3, 3> rows{};
    for (const Triangle& t : mesh.faces) {
        const Vec3 a = corner(t, 0) - m.centroid, b = corner(t, 1) - m.centroid,
                   c = corner(t, 2) - m.centroid;
        const double weight = norm(cross(b - a, c - a)) / 24;
        for (const Vec3& p : {a, b, c, a + b + c}) add_products(p, weight, rows);
    }
    m.centroid += start;
    const PrincipalAxes principal = principal_axes(rows);
    m.axes = principal.axes;
    m.spread = principal.values;
    std::sort(m.spread.begin(), m.spread.end());
    return m;
}

}  // namespace pfgeom
