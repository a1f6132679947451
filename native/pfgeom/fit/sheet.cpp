#include "pfgeom/fit/sheet.h"

#include "pfgeom/fit/simplest_quadric.h"
#include "pfgeom/mesh/edges.h"

namespace pfgeom {
namespace {

QuadricSamples samples_of_surface(const TriangleMesh& mesh, const FitTarget& target) {
    QuadricSamples s;
    for (std::size_t i = 0; i < target.points.size(); ++i)
        s.add(target.points[i], target.inside_out ? -target.normals[i] : target.normals[i], 1);
    for (const auto& [a, b, c] : mesh.faces)
        s.loops += cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    return s;
}

// The direction lies in the surface, away from it.
QuadricSamples samples_of_border(const TriangleMesh& mesh) {
    QuadricSamples s;
    for (const std::int32_t side : EdgeTable(mesh.faces, mesh.vertices.size()).boundary()) {
        const Triangle& t = mesh.faces[side / 3];
        const Vec3 &a = mesh.vertices[t[side % 3]], &b = mesh.vertices[t[(side + 1) % 3]],
                   &c = mesh.vertices[t[(side + 2) % 3]];
        const Vec3 away = normalized(cross(b - a, cross(b - a, c - a)));
        s.add(a, away, norm(b - a) / 2);
        s.add(b, away, norm(b - a) / 2);
        s.loops += cross(a, b);
    }
    return s;
}

}  // namespace

std::optional<SheetFit> fit_sheet(const TriangleMesh& mesh, const FitTarget& target, double tolerance,
                                  double step) {
    const std::optional<Quadric> surface =
        simplest_quadric(samples_of_surface(mesh, target), tolerance, step);
    if (!surface) return {};
    const std::optional<Quadric> trim = simplest_quadric(samples_of_border(mesh), tolerance, step);
    if (!trim) return {};
    return SheetFit{*surface, *trim};
}

}  // namespace pfgeom
