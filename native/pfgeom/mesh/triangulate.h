// A polygon in space to triangles.
#pragma once

#include "pfgeom/base/triangle.h"
#include "pfgeom/base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// `corners` - 2 triangles of the polygon, at least three corners, in its own direction. Convex polygons
/// become fans of their first corner, others are cut by ears. `budget` is lowered by the tests that were
/// made; without budget any polygon becomes a fan.
std::vector<Triangle> triangulate_polygon(const std::vector<Vec3>& vertices,
                                          std::span<const std::int32_t> corners, std::int64_t& budget);

}  // namespace pfgeom
