// Rays against triangles: a mesh's, or a mesh part's, or fine ones near its curved faces.
#pragma once

#include "pfgeom/function/model.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/render/ray_target.h"

#include <cmath>
#include <vector>

namespace pfgeom {

class RayMesh final : public RayTarget {
  public:
    /// `diagonal`: of the model that the object comes from.
    RayMesh(const Object& object, double diagonal, const Task& task);
    RayMesh(const TriangleMesh& mesh, const Task& task);  ///< copies what it needs

    SurfaceHit first_hit(const Ray& ray, const RaySpan& span) const override;
    Extreme extreme(const SearchGoal& goal, double within, double accuracy,
                    ExtremeSearch& search) const override;
    std::vector<Box> cover() const override { return boxes_; }
    bool tells_sides() const override { return false; }
    bool contains(const Vec3& p) const override { return std::abs(bvh_.winding_number(p)) > 0.5; }

  private:
    Bvh bvh_;
    std::vector<Vec3> normals_;  // of each face
    std::vector<Box> boxes_;     // likewise
    std::vector<Vec3> vertices_;
    double chord_ = 0;  // the triangles are this close to curved faces
};

}  // namespace pfgeom
