// Tetrahedra that are cut in two, edge by edge, and stay conforming: faces of neighbours match exactly.
#pragma once

#include "pfgeom/base/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

struct Tetrahedron {
    std::array<std::int32_t, 4> vertex{};  ///< det(v1-v0, v2-v0, v3-v0) > 0
    std::int32_t node = 0;                 ///< of a tree: what is still to be asked
    std::int32_t level = 0;                ///< times it was halved; three halve its edges
};

/// The six edges of a tetrahedron, as pairs of its corners.
constexpr std::array<std::array<int, 2>, 6> kTetrahedronEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
/// Its faces, counter-clockwise seen from outside; face i is opposite corner i.
constexpr std::array<std::array<int, 3>, 4> kTetrahedronFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Open addressing: what has been put on an edge between two vertices.
class TetEdgeTable {
  public:
    /// -1 where there is nothing.
    std::int32_t find(std::int32_t a, std::int32_t b) const;
    void insert(std::int32_t a, std::int32_t b, std::int32_t vertex);  ///< where there is nothing yet

  private:
    struct Entry {
        std::uint64_t key = 0;
        std::int32_t vertex = -1;  // -1: free
    };
    std::size_t slot_of(std::uint64_t key) const;
    void note(std::uint64_t key);

    std::vector<Entry> slots_;
    // A bit for each hash that is in: most edges that are looked up are not, and an eighth of a byte stays in
    // the cache where an entry does not.
    std::vector<std::uint64_t> noted_;
    std::size_t used_ = 0;
};

/// The two halves of a tetrahedron whose edge from corner a to corner b is cut at `middle`.
inline std::array<Tetrahedron, 2> halves(const Tetrahedron& t, int a, int b, std::int32_t middle) {
    std::array<Tetrahedron, 2> both{t, t};
    both[0].vertex[static_cast<std::size_t>(b)] = middle;
    both[1].vertex[static_cast<std::size_t>(a)] = middle;
    return both;
}

}  // namespace pfgeom
