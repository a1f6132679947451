// Disjoint sets of 0 .. n-1; the lowest member represents its set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace pfgeom {

class UnionFind {
  public:
    explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

    std::int32_t find(std::int32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];  // halves the path
        return i;
    }
    void join(std::int32_t i, std::int32_t j) {
        i = find(i);
        j = find(j);
        if (i > j) std::swap(i, j);
        parent_[j] = i;
    }

  private:
    std::vector<std::int32_t> parent_;
};

}  // namespace pfgeom
