// How one surface lies on another of the same shape.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/placement.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/segment/landmarks.h"
#include "pfgeom/segment/surface_moments.h"

#include <optional>

namespace pfgeom {

/// A shape to be laid on others. Immutable, safe from many threads.
class Pattern {
  public:
    explicit Pattern(TriangleMesh mesh);

    /// The similarity after which the vertices of both lie within `tolerance` of the other's surface; a turn
    /// where one will do, else a reflection; scale 1 where that will do. It is found, not proved.
    std::optional<Similarity> laid_on(const TriangleMesh& mesh, const SurfaceMoments& moments,
                                      double tolerance, const Task& task) const;

    const SurfaceMoments& moments() const { return moments_; }
    const TriangleMesh& mesh() const { return mesh_; }

  private:
    TriangleMesh mesh_;
    SurfaceMoments moments_;
    Bvh bvh_;
    std::optional<Landmarks> landmarks_;

    friend class Laying;
};

}  // namespace pfgeom
