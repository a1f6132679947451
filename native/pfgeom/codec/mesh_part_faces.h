// What the encoder of a mesh part looks up: which faces are left, and which of them has a given edge.
#pragma once

#include "pfgeom/base/triangle.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

class FacesLeft {
  public:
    FacesLeft(const std::vector<Triangle>& faces, std::size_t vertices);

    struct Found {
        std::int32_t face = -1;   ///< -1: none left
        std::int32_t third = -1;  ///< its corner that is not on the edge
        bool flipped = false;     ///< it has the edge to -> from
    };
    /// A face with the edge from -> to or to -> from, the lowest of those whose `flipped` is as wanted, if
    /// any.
    Found at_edge(std::int32_t from, std::int32_t to, bool flipped);
    /// The lowest face left, or -1.
    std::int32_t lowest();
    void take(std::int32_t face) { taken_[static_cast<std::size_t>(face)] = 1; }

  private:
    void forget_taken(std::size_t v);

    const std::vector<Triangle>& faces_;
    std::vector<std::int32_t> first_, last_;  // of each vertex: its rows of at_vertex_
    std::vector<std::int32_t> at_vertex_;
    std::vector<std::uint8_t> taken_;
    std::size_t next_ = 0;
};

}  // namespace pfgeom
