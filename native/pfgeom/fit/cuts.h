// What set operations cut off a free form: parts of its surface between creases that lie on one quadric, and
// on whose inner side all of the surface is (flat bases, faces milled flat, drilled holes).
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/quadric.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

struct Cut {
    std::vector<std::int32_t> faces;  ///< rising
    Quadric quadric;                  ///< positive inside
};

/// Disjoint, by falling area. `mesh`: closed, its normals outwards, in the cube. Coefficients are multiples
/// of `step`; no vertex of a cut is farther than `tolerance` from its quadric, and none of the mesh as far on
/// its outer side.
std::vector<Cut> find_cuts(const TriangleMesh& mesh, double tolerance, double step, const Task& task = {});

}  // namespace pfgeom
