// The minimal edges of the octree that the surface crosses, in the order in which they are met: each becomes
// a polygon of the dual mesh.
#pragma once

#include "pfgeom/base/grow.h"
#include "pfgeom/polygonize/samples.h"

#include <map>
#include <vector>

namespace pfgeom {

struct CrossedEdge {
    LatticeEdge edge;
    std::int32_t length = 0;
    std::array<std::int32_t, 4> vertex{-1, -1, -1, -1};  ///< by quadrant
    std::uint8_t own = 0;                                ///< quadrants whose leaf has the edge undivided
    bool rising = false;                                 ///< outside at the low end
};

class CrossedEdges {
  public:
    /// `samples`: all there will be. Room is made for so many edges.
    CrossedEdges(const Samples& samples, std::size_t edges, const Task& task) : samples_(samples) {
        grow(by_sample_, samples.size(), task, {-1, -1, -1});
        list_.reserve(edges);
    }

    const std::vector<CrossedEdge>& list() const { return list_; }
    CrossedEdge& operator[](std::int32_t row) { return list_[static_cast<std::size_t>(row)]; }
    const CrossedEdge& operator[](std::int32_t row) const { return list_[static_cast<std::size_t>(row)]; }

    /// The edge's row; it is appended where it is not in the list.
    std::int32_t find_or_add(const LatticeEdge& edge) {
        const std::int32_t sample = samples_.find(edge.low);
        if (sample >= 0) return find_or_add(edge, sample);
        return appended(edge, elsewhere_.try_emplace(edge.key(), -1).first->second);
    }
    /// The same, given the row of the sample at its low end.
    std::int32_t find_or_add(const LatticeEdge& edge, std::int32_t sample) {
        return appended(edge,
                        by_sample_[static_cast<std::size_t>(sample)][static_cast<std::size_t>(edge.axis)]);
    }
    /// Frees what only finding needs.
    void stop_finding() { std::vector<std::array<std::int32_t, 3>>().swap(by_sample_); }

  private:
    std::int32_t appended(const LatticeEdge& edge, std::int32_t& row) {
        if (row < 0) {
            row = static_cast<std::int32_t>(list_.size());
            list_.push_back({.edge = edge});
        }
        return row;
    }

    const Samples& samples_;
    std::vector<CrossedEdge> list_;
    std::vector<std::array<std::int32_t, 3>> by_sample_;  // at the low end, and axis; -1: not crossed
    std::map<std::uint64_t, std::int32_t> elsewhere_;     // by key: the few whose low end is no sample
};

}  // namespace pfgeom
