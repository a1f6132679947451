// The colour of a surface by its normal.
#pragma once

#include "pfgeom/render/camera.h"

#include <array>
#include <cstdint>

namespace pfgeom {

/// Two lights that move with the camera and a sky: faces of any two directions differ, so creases show.
class Shading {
  public:
    explicit Shading(const Camera& camera);

    /// Of a point that is seen along `direction`; either side of a surface looks alike.
    std::array<std::uint8_t, 4> colour(const Vec3& normal, const Vec3& direction) const;

  private:
    Vec3 key_, fill_, up_;  // towards the lights
};

}  // namespace pfgeom
