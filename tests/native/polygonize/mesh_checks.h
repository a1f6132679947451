// What every mesh of the polygonizer must satisfy, and how far it is from a field's zero set.
#pragma once

#include "pfgeom/eval/scalar_field.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pfgeom::test {

/// Every directed edge once and its reverse once; the faces of every vertex form one fan; none is unused.
inline ::testing::AssertionResult is_closed_manifold(const TriangleMesh& mesh) {
    using ::testing::AssertionFailure;
    const auto n = static_cast<std::int32_t>(mesh.vertices.size());
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    std::vector<std::map<std::int32_t, std::int32_t>> link(mesh.vertices.size());  // around each vertex
    for (const Triangle& f : mesh.faces)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = f[i], b = f[(i + 1) % 3], c = f[(i + 2) % 3];
            if (a < 0 || a >= n || a == b) return AssertionFailure() << "a face with vertex " << a;
            edges.emplace_back(a, b);
            if (!link[a].emplace(b, c).second)
                return AssertionFailure() << "edge " << a << " " << b << " twice";
        }
    std::sort(edges.begin(), edges.end());
    for (const auto& [a, b] : edges)
        if (!std::binary_search(edges.begin(), edges.end(), std::pair{b, a}))
            return AssertionFailure() << "edge " << a << " " << b << " is open";
    for (std::int32_t v = 0; v < n; ++v) {
        if (!is_finite(mesh.vertices[v])) return AssertionFailure() << "vertex " << v << " is not finite";
        if (link[v].empty()) return AssertionFailure() << "vertex " << v << " is unused";
        std::size_t steps = 1;
        const std::int32_t start = link[v].begin()->first;
        for (std::int32_t at = link[v].at(start); at != start && steps <= link[v].size(); ++steps)
            at = link[v].at(at);
        if (steps != link[v].size()) return AssertionFailure() << "vertex " << v << " has several fans";
    }
    return ::testing::AssertionSuccess();
}

inline int euler_characteristic(const TriangleMesh& mesh) {
    return static_cast<int>(mesh.vertices.size()) - static_cast<int>(mesh.faces.size()) / 2;  // E = 3F/2
}

struct Turns {
    int count = 0;
    double length = 0;
};
/// Edges whose faces turn by more than so many degrees.
inline Turns edges_that_turn(const TriangleMesh& mesh, double degrees) {
    std::map<std::pair<std::int32_t, std::int32_t>, Vec3> normals;  // by half-edge
    for (const Triangle& f : mesh.faces) {
        const Vec3& a = mesh.vertices[f[0]];
        const Vec3 n = normalized(cross(mesh.vertices[f[1]] - a, mesh.vertices[f[2]] - a));
        for (std::size_t k = 0; k < 3; ++k) normals[{f[k], f[(k + 1) % 3]}] = n;
    }
    const double cosine = std::cos(degrees * 3.14159265358979323846 / 180);
    Turns turns;
    for (const auto& [edge, n] : normals) {
        const auto& [a, b] = edge;
        if (a > b || dot(n, normals.at({b, a})) >= cosine) continue;
        ++turns.count;
        turns.length += norm(mesh.vertices[a] - mesh.vertices[b]);
    }
    return turns;
}

struct Fit {
    double vertex_max = 0;        ///< |F| / |∇F| at vertices
    double max = 0, rms = 0;      ///< the same at 7 points of each triangle, by area
    double flipped = 0;           ///< share of triangles whose normal points inside
    double thin = 0;              ///< share of triangles with a height below a tenth of the longest side
    double smallest_angle = 180;  ///< degrees, mean over triangles
};

inline double distance_to_zero_set(const ScalarField& field, const Vec3& p, Vec3& gradient) {
    const double value = field.value_and_gradient(p, gradient);
    return std::abs(value) / norm(gradient);
}

inline Fit measure(const ScalarField& field, const TriangleMesh& mesh) {
    constexpr double kPoints[7][2] = {{1 / 3., 1 / 3.}, {.1, .1},  {.8, .1}, {.1, .8},
                                      {.45, .45},       {.1, .45}, {.45, .1}};
    Fit fit;
    Vec3 gradient;
    for (const Vec3& v : mesh.vertices)
        fit.vertex_max = std::max(fit.vertex_max, distance_to_zero_set(field, v, gradient));
    double area = 0, sum = 0, angles = 0;
    for (const Triangle& f : mesh.faces) {
        const Vec3 a = mesh.vertices[f[0]], b = mesh.vertices[f[1]] - a, c = mesh.vertices[f[2]] - a;
        const Vec3 normal = cross(b, c);
        double worst = 0, squares = 0;
        for (const auto& [u, v] : kPoints) {
            const double d = distance_to_zero_set(field, a + b * u + c * v, gradient);
            worst = std::max(worst, d);
            squares += d * d / 7;
        }
        field.value_and_gradient(a + (b + c) / 3, gradient);
        fit.flipped += dot(normal, gradient) > 0;
        const double side = std::max({squared_norm(b), squared_norm(c), squared_norm(b - c)});
        fit.thin += norm(normal) < 0.1 * side;
        const double shortest = std::min({norm(b), norm(c), norm(b - c)});
        const double others = norm(b) * norm(c) * norm(b - c) / shortest;
        angles += others > 0 ? std::asin(std::min(1.0, norm(normal) / others)) * 180 / 3.14159265 : 0;
        fit.max = std::max(fit.max, worst);
        sum += norm(normal) * squares;
        area += norm(normal);
    }
    const auto faces = static_cast<double>(mesh.faces.size());
    fit.rms = std::sqrt(sum / area);
    fit.flipped /= faces;
    fit.thin /= faces;
    fit.smallest_angle = angles / faces;
    return fit;
}

}  // namespace pfgeom::test
