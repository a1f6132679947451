// A triangle mesh as plain arrays: any shape, no invariant but that indices are in range.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/base/triangle.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pfgeom {

struct TriangleMesh {
    std::vector<Vec3> vertices;   ///< #V by 3, the user's units
    std::vector<Triangle> faces;  ///< #F by 3 rows of `vertices`
};

/// Box of the vertices that faces use.
Box bounds(const TriangleMesh& mesh);
/// Diagonal of that box: what relative tolerances refer to.
double diagonal(const TriangleMesh& mesh);
double surface_area(const TriangleMesh& mesh);
/// Adds the mesh's vertices and faces to those of `all`.
void append(const TriangleMesh& mesh, TriangleMesh& all);

}  // namespace pfgeom
