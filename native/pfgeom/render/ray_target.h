// One object as rays see it, and searches for points of it.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/render/extreme.h"
#include "pfgeom/render/ray.h"

#include <vector>

namespace pfgeom {

/// Immutable and safe to use from many threads.
class RayTarget {
  public:
    virtual ~RayTarget() = default;
    /// The first point of the surface with from <= t < to; `object` is left to the caller. In the world,
    /// without the object's further copies.
    virtual SurfaceHit first_hit(const Ray& ray, const RaySpan& span) const = 0;
    /// The point of the surface that serves the goal best, if its cost is below `within`: proved to the
    /// accuracy, or as far as a budget of work goes. Likewise in the world.
    virtual Extreme extreme(const SearchGoal& goal, double within, double accuracy,
                            ExtremeSearch& search) const = 0;
    /// Where the normals of hits do not tell inside from outside (a mesh's): is the point inside?
    virtual bool tells_sides() const { return true; }
    virtual bool contains(const Vec3&) const { return false; }
    /// Boxes that hold the surface together; none if there is no surface.
    virtual std::vector<Box> cover() const = 0;
};

}  // namespace pfgeom
