// Which faces use which edge. An edge is a pair of vertices; its uses are sides of faces, written as
// 3 * face + corner (the side from that corner to the next).
#pragma once

#include "pfgeom/base/triangle.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

struct EdgeUse {
    std::int32_t lo, hi;  ///< the edge's vertices, lo <= hi
    std::int32_t side;    ///< 3 * face + corner
    bool forward;         ///< the side runs from lo to hi

    std::int32_t face() const { return side / 3; }
};

class EdgeTable {
  public:
    EdgeTable(std::span<const Triangle> faces, std::size_t vertices);

    /// Calls visit(std::span<const EdgeUse>) for each edge, by rising (lo, hi); uses by rising side.
    template <class Visit>
    void for_each(Visit visit) const {
        for (std::size_t begin = 0, end = 0; begin < uses_.size(); begin = end) {
            while (end < uses_.size() && uses_[end].lo == uses_[begin].lo && uses_[end].hi == uses_[begin].hi)
                ++end;
            visit(std::span(uses_).subspan(begin, end - begin));
        }
    }
    /// How many sides run between a and b, in either direction.
    std::size_t count(std::int32_t a, std::int32_t b) const;
    /// The sides without a partner, rising.
    std::vector<std::int32_t> boundary() const;

  private:
    std::vector<EdgeUse> uses_;        // by (lo, hi, side)
    std::vector<std::size_t> starts_;  // of each lo
};

}  // namespace pfgeom
