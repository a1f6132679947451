// A ray in the cube of an object's frame, from a point near the object: numbers stay of the order of one.
#pragma once

#include "pfgeom/function/frame.h"
#include "pfgeom/render/ray.h"

namespace pfgeom {

/// A frame's numbers, worked out once.
struct CubePlace {
    Vec3 centre;
    double half = 1;

    explicit CubePlace(const Frame& frame) : centre(frame.centre()), half(frame.half()) {}
    Vec3 to_local(const Vec3& p) const { return (p - centre) / half; }
    Vec3 to_world(const Vec3& p) const { return centre + p * half; }
};

class LocalRay {
  public:
    /// `middle`: in the cube.
    LocalRay(const CubePlace& place, const Ray& world, const RaySpan& span, const Vec3& middle)
        : ray_{place.to_local(world.origin), world.direction / place.half} {
        shift_ = dot(middle - ray_.origin, ray_.direction) / squared_norm(ray_.direction);
        ray_.origin = ray_.at(shift_);
        span_ = {span.from - shift_, span.to - shift_};
    }

    const Ray& ray() const { return ray_; }
    const RaySpan& span() const { return span_; }
    /// Normals are the same in cube and world.
    SurfaceHit to_world(SurfaceHit hit) const {
        hit.t += shift_;
        return hit;
    }

  private:
    Ray ray_;
    double shift_ = 0;
    RaySpan span_;
};

}  // namespace pfgeom
