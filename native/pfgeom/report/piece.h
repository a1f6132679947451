// Flat pieces of a triangle, and how they are made smaller.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

using Corners = std::array<Vec3, 3>;

inline Corners corners_of(const TriangleMesh& mesh, std::int32_t face) {
    const auto& [a, b, c] = mesh.faces[face];
    return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

Vec3 centroid(const Corners& piece);
/// Largest distance of a corner to `centre`.
double radius(const Corners& piece, const Vec3& centre);

/// Two halves: the longest edge is cut in the middle.
std::array<Corners, 2> bisect(const Corners& piece);

/// Cuts the piece along the border of the prism over `triangle`, at the edge that `corner` is farthest
/// outside of. Adds the (three) parts; adds nothing where that would only shave off a splinter.
void cut_along_prism(const Corners& piece, const Corners& triangle, int corner, std::vector<Corners>& parts);

}  // namespace pfgeom
