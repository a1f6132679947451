// The field at corners of cells, each evaluated once: an append-only list with an index. Neighbours are asked
// for one after another, so that the index keeps those of 2³ points of a grid together.
#pragma once

#include "pfgeom/eval/cell_table.h"
#include "pfgeom/polygonize/lattice.h"

#include <vector>

namespace pfgeom {

struct Sample {
    LatticePoint point{};
    std::array<float, 3> normal{};  ///< unit gradient; zero where the gradient is, or has not been asked for
    double value = 0;
};

class Samples {
  public:
    /// Row of the sample at `p`, which is appended, without a value, where there is none yet.
    std::int32_t find_or_add(const LatticePoint& p);
    /// Null where there is none.
    const Sample* find(const LatticePoint& p) const;

    std::size_t size() const { return list_.size(); }
    Sample& operator[](std::size_t i) { return list_[i]; }
    const Sample& operator[](std::size_t i) const { return list_[i]; }

  private:
    std::vector<Sample> list_;
    CellTable groups_;                                // rows of index_
    std::vector<std::array<std::int32_t, 8>> index_;  // rows of list_; -1 where there is none
};

}  // namespace pfgeom
