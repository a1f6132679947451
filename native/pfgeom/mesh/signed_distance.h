// Distance to a closed, oriented surface with its side. One search a query; the winding number (mesh/bvh.h)
// also bears holes, and is ten times as dear. Source: Baerentzen, Aanaes, "Signed distance computation using
// the angle weighted pseudonormal", IEEE TVCG 11(3), 2005.
#pragma once

#include "pfgeom/mesh/bvh.h"

#include <array>
#include <vector>

namespace pfgeom {

struct SignedClosest {
    double distance = 0;  ///< > 0 inside
    std::int32_t face = -1;
    Vec3 point;
};

class SignedDistance {
  public:
    /// `bvh` is the mesh's; both must outlive this. The mesh is closed, oriented, with outward normals.
    SignedDistance(const TriangleMesh& mesh, const Bvh& bvh);

    /// `hint`: a face that is probably close, or -1.
    SignedClosest operator()(const Vec3& p, std::int32_t hint = -1) const;
    const Vec3& face_normal(std::int32_t face) const { return face_normals_[face]; }
    /// The pseudonormal of the face, edge or vertex that p, a point of the face, lies on; of any length.
    Vec3 normal_at(std::int32_t face, const Vec3& p) const;

  private:
    const TriangleMesh& mesh_;
    const Bvh& bvh_;
    std::vector<Vec3> face_normals_;
    std::vector<Vec3> vertex_normals_;
    std::vector<std::array<Vec3, 3>> edge_normals_;  // of the side from each corner to the next
};

}  // namespace pfgeom
