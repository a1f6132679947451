// The island that a tree is looked for, with what every attempt asks of it again.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/signed_distance.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/segment/exact_patches.h"

#include <utility>
#include <vector>

namespace pfgeom {

struct TreeTarget {
    TriangleMesh mesh;  ///< closed, in the cube [-1,1]³, normals outwards
    Bvh bvh;
    SignedDistance distance;
    std::vector<ExactPatch> exact;

    TreeTarget(TriangleMesh in_cube, const Task& task)
        : mesh(std::move(in_cube)), bvh(mesh), distance(mesh, bvh), exact(find_exact_patches(mesh, task)) {}
    TreeTarget(const TreeTarget&) = delete;  // its parts refer to each other
    TreeTarget& operator=(const TreeTarget&) = delete;
};

}  // namespace pfgeom
