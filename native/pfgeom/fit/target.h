// What a hierarchy is fitted to: one closed island in its own cube, sampled.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/frame.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pfgeom {

/// `mesh` in the frame's cube.
TriangleMesh in_cube(TriangleMesh mesh, const Frame& frame);

struct FitTarget {
    Frame frame;
    Vec3 half_extent;           ///< of the island's box, in the cube
    double area = 0;            ///< in the cube
    Bvh bvh;                    ///< of the island in the cube
    bool inside_out = false;    ///< the island's normals point inwards: a cavity's own solid is its inside
    std::vector<Vec3> points;   ///< #S stratified samples, in Morton order
    std::vector<Vec3> normals;  ///< #S, interpolated from the vertices, unit, outwards

    /// `island`: closed, in the world; the faces behind the first `own` only close it, and get a sixteenth of
    /// the samples or, without `with_closing`, none: what is cut away again need not be exact.
    FitTarget(const TriangleMesh& island, std::size_t samples, std::size_t own = SIZE_MAX,
              bool with_closing = true);

    /// Vertices as further samples: where the maximum counts, since that is where the mesh reaches furthest.
    void add_vertices(const TriangleMesh& island);

    /// > 0 inside, in the cube.
    double signed_distance(const Vec3& p) const;
};

}  // namespace pfgeom
