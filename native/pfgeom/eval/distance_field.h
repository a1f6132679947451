// The signed distance to a mesh as a field: positive inside, by the winding number.
#pragma once

#include "pfgeom/eval/scalar_field.h"
#include "pfgeom/mesh/bvh.h"

#include <vector>

namespace pfgeom {

/// Inside is where the mesh winds around a point, in whichever direction. The gradient points along the line
/// to the closest point; on the surface, where that says nothing, across the face.
class DistanceField final : public ScalarField {
  public:
    explicit DistanceField(const TriangleMesh& mesh, const Task& task = {});

    double value(const Vec3& p) const override;
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override;
    Interval range(const Box& box) const override;

    Box bounds() const { return bvh_.bounds(); }

  private:
    Bvh bvh_;
    std::vector<Vec3> inwards_;  // of each face
    double near_ = 0;            // squared distance that is nothing but rounding
};

}  // namespace pfgeom
