// Named shapes for tests: small meshes whose truth is known. Closed shapes have outward normals unless their
// name says otherwise. Only + - * / sqrt are used, so that every machine tests the same bits.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace pfgeom::shapes {

// ---- Tools ----

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
    const auto base = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [i, j, k] : other.faces) mesh.faces.push_back({base + i, base + j, base + k});
}

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
    append(a, b);
    return a;
}

inline TriangleMesh flipped(TriangleMesh mesh) {
    for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

inline TriangleMesh translated(TriangleMesh mesh, const Vec3& by) {
    for (Vec3& v : mesh.vertices) v += by;
    return mesh;
}

inline TriangleMesh scaled(TriangleMesh mesh, const Vec3& by) {
    for (Vec3& v : mesh.vertices) v = {v.x * by.x, v.y * by.y, v.z * by.z};
    return mesh;
}

/// Three vertices of its own for every face, as STL files have it.
inline TriangleMesh soup(const TriangleMesh& mesh) {
    TriangleMesh out;
    for (const Triangle& face : mesh.faces) {
        const auto n = static_cast<std::int32_t>(out.vertices.size());
        for (const std::int32_t v : face) out.vertices.push_back(mesh.vertices[v]);
        out.faces.push_back({n, n + 1, n + 2});
    }
    return out;
}

/// A point of the unit circle, from rational numbers: turns 0, 1/4, 1/2, 3/4 are exact, between them the
/// angle grows not quite evenly.
inline std::array<double, 2> on_circle(double turns) {
    const double quarters = (turns - std::floor(turns)) * 4;
    const int quarter = static_cast<int>(quarters) & 3;
    const double t = quarters - quarter;  // tangent of half the angle within the quarter
    const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
    switch (quarter) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

/// Two triangles for each quad of a grid of rows by columns; `wrap` joins the last column to the first and
/// the last row to the first.
inline std::vector<Triangle> grid_faces(int rows, int columns, bool wrap_rows, bool wrap_columns) {
    std::vector<Triangle> faces;
    for (int i = 0; i + (wrap_rows ? 0 : 1) < rows; ++i)
        for (int j = 0; j + (wrap_columns ? 0 : 1) < columns; ++j) {
            const int i1 = (i + 1) % rows, j1 = (j + 1) % columns;
            const int a = i * columns + j, b = i1 * columns + j, c = i1 * columns + j1, d = i * columns + j1;
            faces.push_back({a, b, c});
            faces.push_back({a, c, d});
        }
    return faces;
}

// ---- Closed manifolds ----

/// Octahedron subdivided `levels` times, all vertices on the sphere: 8 * 4^levels faces.
inline TriangleMesh sphere(int levels = 3, double radius = 1, const Vec3& centre = {}) {
    TriangleMesh mesh{
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [it, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
            if (fresh) mesh.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]));
            return it->second;
        };
        std::vector<Triangle> faces;
        for (const auto& [a, b, c] : mesh.faces) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.faces = std::move(faces);
    }
    return translated(scaled(std::move(mesh), {radius, radius, radius}), centre);
}

inline TriangleMesh ellipsoid(const Vec3& radii, int levels = 3) {
    return scaled(sphere(levels), radii);
}

/// A sphere with smooth bumps: a free form without symmetry. r = 1 + amplitude * a cubic in the direction.
inline TriangleMesh bumpy_sphere(int levels = 4, double amplitude = 0.3) {
    TriangleMesh mesh = sphere(levels);
    for (Vec3& v : mesh.vertices) v *= 1 + amplitude * (v.x * v.y + v.y * v.y * v.z - 2 * v.x * v.z * v.z);
    return mesh;
}

inline TriangleMesh torus(double major = 1, double minor = 0.4, int around = 32, int across = 16) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const auto [cu, su] = on_circle(static_cast<double>(i) / around);
            const auto [cv, sv] = on_circle(static_cast<double>(j) / across);
            const double r = major + minor * cv;
            mesh.vertices.push_back({r * cu, r * su, minor * sv});
        }
    mesh.faces = grid_faces(around, across, true, true);
    return mesh;
}

inline TriangleMesh cube(double half = 1, const Vec3& centre = {}) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back(centre +
                                Vec3{i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
    mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// Radius 1 about the z axis, from z = -1 to 1, capped: smooth, flat and creased at once.
inline TriangleMesh cylinder(int sides = 32) {
    TriangleMesh mesh;
    for (const double z : {1.0, -1.0})
        for (int j = 0; j < sides; ++j) {
            const auto [c, s] = on_circle(static_cast<double>(j) / sides);
            mesh.vertices.push_back({c, s, z});
        }
    mesh.faces = grid_faces(2, sides, false, true);
    mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 1}, {0, 0, -1}});
    for (int j = 0; j < sides; ++j) {
        const int next = (j + 1) % sides;
        mesh.faces.push_back({2 * sides, j, next});
        mesh.faces.push_back({2 * sides + 1, sides + next, sides + j});
    }
    return mesh;
}

// ---- Open and one-sided surfaces ----

/// Apex (0,0,1), base circle of radius 1 at z = 0, no bottom.
inline TriangleMesh open_cone(int sides = 32) {
    TriangleMesh mesh;
    for (int j = 0; j < sides; ++j) {
        const auto [c, s] = on_circle(static_cast<double>(j) / sides);
        mesh.vertices.push_back({c, s, 0});
        mesh.faces.push_back({j, (j + 1) % sides, sides});
    }
    mesh.vertices.push_back({0, 0, 1});
    return mesh;
}

/// Closed and of no quadrics; symmetric in x = 0 and in no other plane.
inline TriangleMesh casting() {
    TriangleMesh mesh = sphere(4);
    for (Vec3& v : mesh.vertices) v *= 1 + 0.2 * (v.y * v.z * v.z - v.x * v.x * v.y) + 0.3 * v.z * v.y * v.y;
    return mesh;
}

/// z = height * x y over [-1,1]².
inline TriangleMesh saddle(int cells = 16, double height = 0.5) {
    TriangleMesh mesh;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j) {
            const double x = -1 + 2.0 * i / cells, y = -1 + 2.0 * j / cells;
            mesh.vertices.push_back({x, y, height * x * y});
        }
    mesh.faces = grid_faces(cells + 1, cells + 1, false, false);
    return mesh;
}

/// One half twist, one boundary loop of 2 * around edges; cannot be oriented.
inline TriangleMesh moebius(int around = 48, double width = 0.4) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i) {
        const auto [c, s] = on_circle(static_cast<double>(i) / around);
        const auto [ch, sh] = on_circle(static_cast<double>(i) / around / 2);
        for (const double w : {-width, width}) {
            const double r = 1 + w * ch;
            mesh.vertices.push_back({r * c, r * s, w * sh});
        }
    }
    mesh.faces = grid_faces(around, 2, false, false);
    const int a = 2 * (around - 1), b = a + 1;  // the last quad meets the first with its sides exchanged
    mesh.faces.push_back({a, 1, 0});
    mesh.faces.push_back({a, 0, b});
    return mesh;
}

/// Closed, one-sided (the "figure 8" immersion): every edge has two faces, no orientation fits.
inline TriangleMesh klein_bottle(int around = 32, int across = 16) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i) {
        const auto [c, s] = on_circle(static_cast<double>(i) / around);
        const auto [ch, sh] = on_circle(static_cast<double>(i) / around / 2);
        for (int j = 0; j < across; ++j) {
            const auto [cv, sv] = on_circle((j + 0.5) / across);  // no vertex where the 8 crosses itself
            const double p = 0.5 * sv, q = 0.5 * sv * cv;         // the figure 8, turned by half the angle
            const double r = 2 + ch * p - sh * q;
            mesh.vertices.push_back({r * c, r * s, sh * p + ch * q});
        }
    }
    mesh.faces = grid_faces(around, across, false, true);
    for (int j = 0; j < across; ++j) {  // after one turn the figure has turned by half: (p,q) meets (-p,-q)
        const int j1 = (j + 1) % across, last = (around - 1) * across;
        const int k = across - 1 - j, k1 = across - 1 - j1;
        mesh.faces.push_back({last + j, k, k1});
        mesh.faces.push_back({last + j, k1, last + j1});
    }
    return mesh;
}

// ---- Defects ----

/// A sphere whose every `every`-th face is turned over.
inline TriangleMesh misoriented_sphere(int every = 7, int levels = 2) {
    TriangleMesh mesh = sphere(levels);
    for (std::size_t i = 0; i < mesh.faces.size(); i += static_cast<std::size_t>(every))
        std::swap(mesh.faces[i][1], mesh.faces[i][2]);
    return mesh;
}

/// `blades` triangles around one common edge, the z axis from 0 to 1.
inline TriangleMesh edge_fan(int blades = 5) {
    TriangleMesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}};
    for (int j = 0; j < blades; ++j) {
        const auto [c, s] = on_circle(static_cast<double>(j) / blades);
        mesh.vertices.push_back({c, s, 0.5});
        mesh.faces.push_back({0, 1, j + 2});
    }
    return mesh;
}

/// Two cubes that share nothing but the point (1,1,1), as one vertex: a bow tie.
inline TriangleMesh cubes_sharing_vertex() {
    TriangleMesh mesh = joined(cube(), cube(1, {2, 2, 2}));
    for (Triangle& face : mesh.faces)
        for (std::int32_t& v : face)
            if (v == 8) v = 7;
    return mesh;
}

/// Two cubes that share the edge x = y = 1 (four faces), their vertices each its own.
inline TriangleMesh cubes_sharing_edge() {
    return joined(cube(), cube(1, {2, 2, 0}));
}

/// Two cubes that touch on a part of a face; no vertex or edge in common.
inline TriangleMesh touching_cubes() {
    return joined(cube(), cube(1, {2, 0.5, 0.25}));
}

/// `n` triangles around the origin, each `ratio` times as long as it is wide.
inline TriangleMesh sliver_fan(int n = 12, double ratio = 1e6) {
    TriangleMesh mesh{{{0, 0, 0}}, {}};
    for (int j = 0; j < n; ++j) {
        const auto [c, s] = on_circle(static_cast<double>(j) / n);
        mesh.vertices.push_back({c, s, 0});
        mesh.vertices.push_back({c - s / ratio, s + c / ratio, 0});
        mesh.faces.push_back({0, 2 * j + 1, 2 * j + 2});
    }
    return mesh;
}

/// A cube whose front is split at the middle of an edge where the top is not (a T-junction), every face with
/// vertices of its own that are off by up to `gap`: STL cracks.
inline TriangleMesh cracked_cube(double gap = 1e-5, std::uint64_t seed = 1) {
    TriangleMesh mesh = cube();
    mesh.vertices.push_back({0.2, -1, 1});                 // on the edge between 4 and 5
    mesh.faces[4] = {0, 1, 8}, mesh.faces[5] = {0, 8, 4};  // the front: 0 1 5 4 with 8 between 5 and 4
    mesh.faces.push_back({1, 5, 8});
    mesh = soup(mesh);
    Random random(seed);
    for (Vec3& v : mesh.vertices) v += Vec3{random.uniform(), random.uniform(), random.uniform()} * (gap / 2);
    return mesh;
}

// ---- Scenes ----

/// Concentric spheres of radius 1, 1/2, 1/4 ..., normals out of the material: outwards, inwards, outwards ...
inline TriangleMesh nested_shells(int shells = 3, int levels = 2) {
    TriangleMesh mesh;
    double radius = 1;
    for (int i = 0; i < shells; ++i, radius /= 2) {
        const TriangleMesh shell = sphere(levels, radius);
        append(mesh, i % 2 ? flipped(shell) : shell);
    }
    return mesh;
}

/// `n` islands on a lattice of pitch 4, by turns: a sphere; a cavity inside that sphere; a torus; an open
/// cone; a cube; a cube that touches the one before; an ellipsoid; a sphere that overlaps it.
inline TriangleMesh scene_of_islands(int n, int levels = 1) {
    int side = 1;
    while (side * side * side * 8 < n + 7) ++side;
    TriangleMesh mesh;
    for (int i = 0; i < n; ++i) {
        const int site = 3 * (i / 8);  // three sites a round of eight islands
        const auto at = [&](int step) {
            const int s = site + step, row = s / (3 * side);
            return Vec3{4.0 * (s % (3 * side)), 4.0 * (row % side), 4.0 * (row / side)};
        };
        switch (i % 8) {
            case 0:
                append(mesh, sphere(levels + 1, 1, at(0)));
                break;
            case 1:
                append(mesh, flipped(sphere(levels, 0.4, at(0) + Vec3{0.2, 0, 0.1})));
                break;
            case 2:
                append(mesh, translated(torus(0.6, 0.25, 12, 8), at(0) + Vec3{0, 0, 2}));
                break;
            case 3:
                append(mesh, translated(open_cone(12), at(1) + Vec3{0, 0, 1.5}));
                break;
            case 4:
                append(mesh, cube(0.5, at(1) + Vec3{-0.5, 0, 0}));
                break;
            case 5:
                append(mesh, cube(0.4, at(1) + Vec3{0.4, 0.2, 0.1}));
                break;
            case 6:
                append(mesh, translated(ellipsoid({1, 0.6, 0.5}, levels + 1), at(2)));
                break;
            default:
                append(mesh, sphere(levels, 0.7, at(2) + Vec3{0.9, 0, 0}));
                break;
        }
    }
    return mesh;
}

}  // namespace pfgeom::shapes
