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

    /// `near`: a foot point inside a curved face that is no farther is taken without a look at the others.
    NearestFace(const Patch& patch, double near);

    /// `good_enough`: the search ends with the first face that is as close; it begins with the likeliest.
    Found operator()(const Vec3& p, std::size_t likely, double good_enough) const;
    /// Row of face f in patch.after, where its samples most likely go.
    std::size_t row_of(std::int32_t f) const;

  private:
    // A curved face: a ball around it, and what gives the weights of its corners at the foot on its plane.
    struct Row {
        Vec3 centre;
        double radius = 0;
        Vec3 first, second;
        double first_offset = 0, second_offset = 0;
        double bend = 0;  // no point is farther from the flat face
    };
    Found flat(const Vec3& p, std::size_t likely, double good_enough) const;
    Found curved(const Vec3& p, std::size_t likely, double good_enough) const;

    const Patch& patch_;
    double near_squared_;
    std::vector<Row> rows_;
};

}  // namespace pfgeom
