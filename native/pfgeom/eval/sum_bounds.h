// Bounds of a level's sum Σ f q³ over boxes of any size: sums of the negative and of the positive factors in
// each cell of the ball grid, and their extremes over ever larger cells. A box looks into at most eight
// cells.
#pragma once

#include "pfgeom/eval/ball_grid.h"

#include <span>
#include <vector>

namespace pfgeom {

class SumBounds {
  public:
    SumBounds() = default;
    SumBounds(const BallGrid& grid, std::span<const double> factors);

    /// Contains Σ f q³ at every point of the box; always contains 0.
    Interval over(const Box& box) const;

  private:
    struct Scale {
        double inverse_size = 0;
        CellTable table;
        std::vector<Interval> sums;
    };
    std::vector<Scale> scales_;  // cell size: radius · 2^k
};

}  // namespace pfgeom
