#include "scenes.h"

#include "shapes.h"

#include <cstdint>
#include <functional>

namespace scenes {
namespace {

using pfgeom::TriangleMesh;
using pfgeom::Vec3;

// The six n × n grids of the cube [-1,1]³, each point passed through `shape`. Their common borders are exact
// duplicates, so that they also go through the welding.
TriangleMesh cube_grid(int n, const std::function<Vec3(const Vec3&)>& shape) {
    TriangleMesh mesh;
    for (int side = 0; side < 6; ++side) {
        const auto first = static_cast<std::int32_t>(mesh.vertices.size());
        const double sign = side < 3 ? 1 : -1;
        for (int k = 0; k < (n + 1) * (n + 1); ++k) {
            Vec3 p;
            p[side % 3] = sign;
            p[(side + 1) % 3] = 2.0 * (k / (n + 1)) / n - 1;
            p[(side + 2) % 3] = sign * (2.0 * (k % (n + 1)) / n - 1);
            mesh.vertices.push_back(shape(p));
        }
        for (int k = 0; k < n * n; ++k) {
            const std::int32_t a = first + k / n * (n + 1) + k % n, b = a + n + 1;
            mesh.faces.push_back({a, b, b + 1});
            mesh.faces.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

// A free form: the sphere with smooth bumps of several sizes.
Vec3 pebble(const Vec3& p) {
    const Vec3 d = normalized(p);
    const double bumps = d.x * d.y * (3 - 4 * d.z * d.z) + d.y * d.z * d.x * (5 * d.x * d.x - 1);
    return d * (1 + 0.15 * bumps + 0.05 * (2 * d.z * d.z - 1) * d.x);
}

// An open panel: a saddle over a square.
TriangleMesh saddle(int n) {
    TriangleMesh mesh;
    for (int k = 0; k < (n + 1) * (n + 1); ++k) {
        const double x = 2.0 * (k % (n + 1)) / n - 1, y = 2.0 * (k / (n + 1)) / n - 1;
        mesh.vertices.push_back({x, y, 0.4 * (x * x - y * y)});
    }
    for (int k = 0; k < n * n; ++k) {
        const std::int32_t a = k / n * (n + 1) + k % n, b = a + n + 1;
        mesh.faces.push_back({a, a + 1, b + 1});
        mesh.faces.push_back({a, b + 1, b});
    }
    return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& part, double scale, const Vec3& offset,
            bool inside_out = false) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& v : part.vertices) mesh.vertices.push_back(v * scale + offset);
    for (auto [a, b, c] : part.faces) {
        if (inside_out) std::swap(b, c);
        mesh.faces.push_back({first + a, first + b, first + c});
    }
}

// Islands that touch, overlap and lie in each other, one of them a cavity, and an open one.
TriangleMesh archipelago() {
    const TriangleMesh ball = cube_grid(8, [](const Vec3& p) { return normalized(p); });
    const TriangleMesh box = cube_grid(2, [](const Vec3& p) { return p; });
    TriangleMesh mesh;
    append(mesh, ball, 1.0, {0, 0, 0});
    append(mesh, ball, 0.5, {0, 0, 0}, true);
    append(mesh, ball, 0.7, {1.7, 0, 0});
    append(mesh, box, 0.5, {0, 2, 0.25});
    append(mesh, box, 0.4, {0.5, 2.3, 0.25});
    append(mesh, saddle(8), 0.6, {2, 2, 0});
    return mesh;
}

}  // namespace

std::vector<Scene> all() {
    const auto sphere = [](const Vec3& p) { return normalized(p); };
    const auto ellipsoid = [](const Vec3& p) {
        const Vec3 d = normalized(p);
        return Vec3{d.x, 0.6 * d.y, 0.35 * d.z};
    };
    return {{"sphere", cube_grid(16, sphere), 1e-3},
            {"ellipsoid", cube_grid(16, ellipsoid), 1e-3},
            {"cube", cube_grid(4, [](const Vec3& p) { return p; }), 1e-3},
            {"torus", pfgeom::shapes::torus(1.0, 0.45, 40, 24), 5e-3},
            {"pebble", cube_grid(16, pebble), 5e-3},
            {"saddle", saddle(20), 2e-3},
            {"archipelago", archipelago(), 5e-3}};
}

}  // namespace scenes
