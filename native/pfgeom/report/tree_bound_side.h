// Which side of a closed mesh is inside, whichever way its normals point, and where that has no answer.
#pragma once

#include "pfgeom/mesh/signed_distance.h"
#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// Immutable, safe to use from many threads.
class SurfaceSides {
  public:
    SurfaceSides(const TriangleMesh& mesh, const Bvh& bvh, const Task& task);

    /// Every island is a closed, oriented manifold, and together they enclose a volume.
    bool defined() const { return orientation_ != 0; }

    /// `hint` as SignedDistance takes it.
    SignedClosest at(const Vec3& p, std::int32_t hint) const;

    /// Unit vectors that point out of the solid.
    Vec3 face_normal(std::int32_t face) const { return distance_.face_normal(face) * orientation_; }
    Vec3 normal_at(const SignedClosest& closest) const;

    const TriangleMesh& mesh() const { return mesh_; }
    const Bvh& bvh() const { return bvh_; }

  private:
    const TriangleMesh& mesh_;
    const Bvh& bvh_;
    double orientation_;  // 1: normals point outwards; -1: inwards; 0: sides are undefined
    SignedDistance distance_;
};

}  // namespace pfgeom
