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

    /// `near`: a foot point inside a face that is no farther is taken without a look at the others.
    NearestFace(const Patch& patch, double near);

    /// `good_enough`: the search ends with the first face that is as close; it begins with the likeliest.
    Found operator()(const Vec3& p, std::size_t likely, double good_enough) const;
    /// Row of face f in patch.after, where its samples most likely go.
    std::size_t row_of(std::int32_t f) const;

  private:
    // Of a face: a ball around it, and what gives the weights of its corners at the foot on its plane.
    struct Row {
        Vec3 centre;
        double radius = 0;
        Vec3 first, second;
        double first_offset = 0, second_offset = 0;
        double bend = 0;  // no point of a curved face is farther from the flat one
    };
    // The face that the point is above, or most nearly, and the weights of its corners there; it begins with
    // the likeliest.
    struct Above {
        std::size_t row = 0;
        Vec3 weights;
        double inside = -std::numeric_limits<double>::infinity();  // the least of them
    };
    Above face_below(const Vec3& p, std::size_t likely) const;
    Found flat(const Vec3& p, std::size_t likely, double good_enough) const;
    Found curved(const Vec3& p, std::size_t likely, double good_enough) const;

    const Patch& patch_;
    double near_squared_;
    std::vector<Row> rows_;
};

}  // namespace pfgeom
