// The field at corners of cells, each evaluated once: an append-only list with an open-addressing index.
#pragma once

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
    std::size_t slot_of(const LatticePoint& p) const;
    void grow();

    std::vector<Sample> list_;
    std::vector<std::int32_t> slots_;  // a power of two of them, at most half taken; -1 where free
};

}  // namespace pfgeom
