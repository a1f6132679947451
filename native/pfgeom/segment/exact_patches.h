// Patches of a surface whose vertices lie on one quadric far better than any tolerance asks: tessellations of
// true quadrics. Merging faces within the tolerance would split such a quadric into many, since the faces
// miss it by their sagitta; its vertices do not.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/quadric.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

struct ExactPatch {
    std::vector<std::int32_t> faces;  ///< rising
    Quadric quadric;                  ///< of their vertices; positive inside
};

/// Disjoint. Flat ones are left to the merging of faces, which needs no evidence.
std::vector<ExactPatch> find_exact_patches(const TriangleMesh& mesh, const Task& task = {});

/// The share of the area that looks like a tessellation of quadrics: exact patches, and faces with a
/// neighbour in their plane, as in flat sides and in strips along cylinders and cones. Costs a look at every
/// edge: to be asked before anything dear is tried on a large mesh.
double exact_share(const TriangleMesh& mesh, std::span<const ExactPatch> patches);
/// Half of it: parts and unions of ellipsoids have 0.9 to 1, scans less than 0.1.
inline bool is_tessellation(const TriangleMesh& mesh, std::span<const ExactPatch> patches) {
    return exact_share(mesh, patches) >= 0.5;
}

}  // namespace pfgeom
