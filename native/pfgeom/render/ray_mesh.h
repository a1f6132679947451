// Rays against triangles: a mesh's, or a mesh part's, or fine ones near its curved faces.
#pragma once

#include "pfgeom/function/model.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/render/ray_target.h"

#include <vector>

namespace pfgeom {

class RayMesh final : public RayTarget {
  public:
    RayMesh(const Model& model, const Object& object, const Task& task);
    RayMesh(const TriangleMesh& mesh, const Task& task);  ///< copies what it needs

    SurfaceHit first_hit(const Ray& ray, const RaySpan& span) const override;
    Extreme extreme(const SearchGoal& goal, double within, double accuracy,
                    ExtremeSearch& search) const override;
    std::vector<Box> cover() const override { return boxes_; }

  private:
    Bvh bvh_;
    std::vector<Vec3> normals_;  // of each face
    std::vector<Box> boxes_;     // likewise
    std::vector<Vec3> vertices_;
    double chord_ = 0;  // the triangles are this close to curved faces
};

}  // namespace pfgeom
