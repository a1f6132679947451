// Questions that are fields, in the cells of the refinement: which have one answer there, and how flat their
// zero sets are.
#pragma once

#include "pfgeom/base/vec.h"
#include "pfgeom/eval/function_field.h"
#include "pfgeom/polygonize/cut_solid.h"

#include <array>
#include <vector>

namespace pfgeom {

class SmoothCells {
  public:
    explicit SmoothCells(const CutSolid& solid) : solid_(solid) {}

    /// 1 or -1 if the question has one answer in the tetrahedron, else 0. `vertex`: names for its corners.
    int side(std::int32_t question, const std::array<Vec3, 4>& p, const std::array<std::int32_t, 4>& vertex);
    /// Of the zero set from a plane, as octree.cpp estimates it; the longest edge where normals turn by more
    /// than 60 degrees, or the cell is larger than it may be.
    double deviation(std::int32_t question, const std::array<Vec3, 4>& p,
                     const std::array<std::int32_t, 4>& vertex);

  private:
    int side_by_slope(std::int32_t question, const std::array<Vec3, 4>& p,
                      const std::array<std::int32_t, 4>& vertex);
    struct Known {
        std::int32_t vertex = -1, question = -1;
        Jet jet;  // the gradient is a unit vector
    };
    const Jet& jet(std::int32_t question, const Vec3& p, std::int32_t vertex);

    const CutSolid& solid_;
    std::vector<Known> known_;  // the latest; cells are looked at depth first
};

}  // namespace pfgeom
