// Which face of a patch a point is closest to.
#pragma once

#include "pfgeom/fit/collapse_mesh.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace pfgeom {

class NearestFace {
  public:
    struct Found {
        std::size_t row = 0;
        Vec3 point;
        double squared = std::numeric_limits<double>::infinity();
        Vec3 weights;  ///< of the corners; of curved patches only
    };

    explicit NearestFace(const Patch& patch);

    /// `good_enough`: the search ends with the first face that is as close; it begins with the likeliest.
    Found operator()(const Vec3& p, std::size_t likely, double good_enough) const;
    /// Row of face f in patch.after, where its samples most likely go.
    std::size_t row_of(std::int32_t f) const;

  private:
    struct Ball {
        Vec3 centre;
        double radius = 0;
    };
    void look_at(std::size_t row, const Vec3& p, Found& best) const;

    const Patch& patch_;
    std::vector<Ball> balls_;  // around curved faces
};

}  // namespace pfgeom
