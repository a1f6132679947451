// Shapes in other places, and shapes without any symmetry.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/function/placement.h"
#include "shapes.h"

#include <utility>

namespace pfgeom::shapes {

/// Any turn, within `reach` of the origin on each axis.
inline Similarity random_place(Random& random, double reach, bool mirrored = false, double scale = 1) {
    const auto any = [&] { return 2 * random.uniform() - 1; };
    Similarity s{
        scale, rotation_of({any(), any(), any(), any()}), {reach * any(), reach * any(), reach * any()}};
    if (mirrored) {
        for (Vec3& row : s.rows) row.x = -row.x;
    }
    return s;
}

/// Closed shapes stay oriented as they were.
inline TriangleMesh placed(TriangleMesh mesh, const Similarity& s) {
    for (Vec3& v : mesh.vertices) v = s.apply(v);
    return dot(s.rows[0], cross(s.rows[1], s.rows[2])) < 0 ? flipped(std::move(mesh)) : mesh;
}

/// Bent so that no turn and no mirror brings it onto itself.
inline TriangleMesh warped(TriangleMesh mesh) {
    for (Vec3& v : mesh.vertices) {
        v = {v.x * (1.2 + 0.2 * v.y), v.y * (1 + 0.15 * v.z), v.z * (0.9 + 0.2 * v.x) + 0.1 * v.x * v.y};
    }
    return mesh;
}

/// The same surface with its vertices and faces in another order.
inline TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
    Random random(seed);
    const auto order = [&](std::size_t n) {
        std::vector<std::int32_t> rows(n);
        for (std::size_t i = 0; i < n; ++i) rows[i] = static_cast<std::int32_t>(i);
        for (std::size_t i = n; i-- > 1;) std::swap(rows[i], rows[random.below(i + 1)]);
        return rows;
    };
    TriangleMesh other;
    const std::vector<std::int32_t> to = order(mesh.vertices.size());
    other.vertices.resize(to.size());
    for (std::size_t v = 0; v < to.size(); ++v) other.vertices[to[v]] = mesh.vertices[v];
    for (const std::int32_t f : order(mesh.faces.size())) {
        const Triangle& t = mesh.faces[f];
        other.faces.push_back({to[t[1]], to[t[2]], to[t[0]]});
    }
    return other;
}

/// Four faces for each: the same surface in another tessellation.
inline TriangleMesh divided(const TriangleMesh& mesh) {
    TriangleMesh finer;
    for (const Triangle& t : mesh.faces) {
        const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        const auto first = static_cast<std::int32_t>(finer.vertices.size());
        for (const Vec3& p : {a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2}) finer.vertices.push_back(p);
        for (const Triangle& part : {Triangle{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
            finer.faces.push_back({part[0] + first, part[1] + first, part[2] + first});
    }
    return finer;
}

}  // namespace pfgeom::shapes
