// Separators: quadrics that are no surface of the part but tell two of its surfaces apart where these touch.
// Near a tangent seam, as between a flat side and the cylinder that rounds its edge, each quadric is right on
// its own side of the seam only, and neither says which side that is. A plane across the seam does; without
// one the tree takes cuts across axes, stair by stair, where the part stands askew.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/tree_quadric.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// `of_face`: of each face its quadric. One separator may serve several seams, as a pair of planes does on
/// both sides of a slot; QuantisedQuadric::between names them.
std::vector<QuantisedQuadric> find_separators(const TriangleMesh& mesh,
                                              std::span<const QuantisedQuadric> quadrics,
                                              const std::vector<std::int32_t>& of_face, int resolution,
                                              int scales, double tolerance, const Task& task);

}  // namespace pfgeom
