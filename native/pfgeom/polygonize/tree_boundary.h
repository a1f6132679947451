// The border between the cells inside and outside a solid, as triangles that know their question.
#pragma once

#include "pfgeom/base/triangle.h"
#include "pfgeom/polygonize/tree_cells.h"

namespace pfgeom {

/// The question whose zero set a face lies on, and its side: 2 · question + (1 if the inside is where the
/// quadric is negative).
using Label = std::int32_t;

/// Closed (as many faces along an edge as against it), but edges may have more than two faces.
struct TreeBoundary {
    std::vector<Vec3> position;
    std::vector<Triangle> faces;  ///< counter-clockwise seen from outside
    std::vector<Label> label;     ///< by face
};

TreeBoundary boundary_of(const CutSolid& solid, TreeCells&& cells, const Task& task);

}  // namespace pfgeom
