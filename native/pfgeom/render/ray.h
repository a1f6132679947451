// Rays, and what they meet.
#pragma once

#include "pfgeom/base/vec.h"

#include <cstdint>
#include <limits>

namespace pfgeom {

/// The points origin + t · direction; the direction may have any length but zero.
struct Ray {
    Vec3 origin, direction;

    Vec3 at(double t) const { return origin + t * direction; }
};

/// The part of a ray that counts.
struct RaySpan {
    double from = 0, to = std::numeric_limits<double>::infinity();
};

struct SurfaceHit {
    double t = std::numeric_limits<double>::infinity();  ///< infinity: nothing
    Vec3 normal;  ///< of unit length, from inside to outside; of an open surface: against its gradient
    std::int32_t object = -1;  ///< row of Model::objects
    /// Of a tree: row of its quadrics, or -1 where a cut or a side of its box is the surface. Of a solid or
    /// a sheet: row of Model::functions, or -1 on a side of its cube. Of a mesh part: the object's own face.
    std::int32_t function = -1;

    bool found() const { return t < std::numeric_limits<double>::infinity(); }
};

}  // namespace pfgeom
