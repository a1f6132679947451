#include "pfgeom/fit/sheet.h"

#include "pfgeom/fit/moments.h"
#include "pfgeom/fit/quadric.h"
#include "pfgeom/mesh/edges.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace pfgeom {
namespace {

// Of normals against distances. Where points alone leave several quadrics (all that vanish on two circles of
// a tube), normals decide; a small weight does not pull quadrics whose gradients differ in length.
constexpr double kNormalWeight = 1e-5;

// Points, and what the quadric falls along there.
struct Samples {
    std::vector<Vec3> points, directions;
    std::vector<double> weights;
    Vec3 loops;  // twice the vector area of directed edges that close up: the normal of planar ones

    void add(const Vec3& point, const Vec3& direction, double weight) {
        points.push_back(point);
        directions.push_back(direction);
        weights.push_back(weight);
    }
};

Samples samples_of_surface(const TriangleMesh& mesh, const FitTarget& target) {
    Samples s;
    for (std::size_t i = 0; i < target.points.size(); ++i)
        s.add(target.points[i], target.inside_out ? -target.normals[i] : target.normals[i], 1);
    for (const auto& [a, b, c] : mesh.faces)
        s.loops += cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    return s;
}

// The direction lies in the surface, away from it.
Samples samples_of_border(const TriangleMesh& mesh) {
    Samples s;
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

double largest_distance(const Quadric& q, std::span<const Vec3> points) {
    double most = 0;
    for (const Vec3& p : points) most = std::max(most, first_order_distance(q, p));
    return most;
}

// Falls along the directions.
Quadric plane_of(const Samples& samples) {
    Vec3 normal = normalized(samples.loops), centre;
    double weight = 0, along = 0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        centre += samples.points[i] * samples.weights[i];
        weight += samples.weights[i];
        along += samples.weights[i] * dot(normal, samples.directions[i]);
    }
    if (along < 0) normal = -normal;
    return {{0, 0, 0, 0, 0, 0, -normal.x, -normal.y, -normal.z, dot(normal, centre) / weight}};
}

std::optional<Quadric> simplest(const Samples& samples, double tolerance, double step) {
    if (samples.points.empty()) return {};
    if (norm(samples.loops) > 0) {
        const Quadric plane = scaled_and_rounded(plane_of(samples), samples.points, step);
        if (largest_distance(plane, samples.points) <= tolerance) return plane;
    }
    Moments moments;
    for (std::size_t i = 0; i < samples.points.size(); ++i)
        moments.add(samples.points[i], samples.directions[i], samples.weights[i]);
    const Quadric raw = moments.solve(kNormalWeight);
    if (!std::ranges::all_of(raw.c, [](double c) { return std::isfinite(c); })) return {};
    const Quadric rounded = scaled_and_rounded(raw, samples.points, step);
    if (!(largest_distance(rounded, samples.points) <= tolerance)) return {};
    return rounded;
}

}  // namespace

std::optional<SheetFit> fit_sheet(const TriangleMesh& mesh, const FitTarget& target, double tolerance,
                                  double step) {
    const std::optional<Quadric> surface = simplest(samples_of_surface(mesh, target), tolerance, step);
    if (!surface) return {};
    const std::optional<Quadric> trim = simplest(samples_of_border(mesh), tolerance, step);
    if (!trim) return {};
    return SheetFit{*surface, *trim};
}

}  // namespace pfgeom
