// A segment and a triangle cut by the planes of a material tree, exactly.
#pragma once

#include "pfgeom/function/material_map.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

/// Where the material changes between a and b: shares of the way, rising.
std::vector<double> material_changes(const MaterialTree& tree, const Vec3& a, const Vec3& b);

struct TriangleMaterials {
    std::int32_t main = 0;  ///< the one of most of the area
    /// The point of the others' pieces (corners and middles) that is farthest from the triangle's sides, and
    /// how far: what is lost if the triangle has one material.
    double depth = 0;
    Vec3 deepest;
};
TriangleMaterials triangle_materials(const MaterialTree& tree, const std::array<Vec3, 3>& corners);

}  // namespace pfgeom
