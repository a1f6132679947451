// Integer points of the finest grid that the octree can reach: exact, so that cells of different size agree
// about the corners that they share.
#pragma once

#include "pfgeom/base/vec.h"

#include <array>
#include <cstdint>

namespace pfgeom {

using LatticePoint = std::array<std::int32_t, 3>;  ///< 0 .. 2^max_depth on each axis

constexpr int kDeepest = 20;  ///< largest max_depth: a coordinate takes 21 bits, a point 63

constexpr std::uint64_t point_key(const LatticePoint& p) {
    return static_cast<std::uint64_t>(p[0]) | static_cast<std::uint64_t>(p[1]) << 21 |
           static_cast<std::uint64_t>(p[2]) << 42;
}

constexpr std::uint64_t hash_key(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15ULL;  // 2^64 / golden ratio; the high bits are then well mixed
    return key ^ (key >> 32);
}

/// The two axes after `axis`, so that (axis, u, v) is right-handed.
constexpr int next_axis(int axis) {
    return axis == 2 ? 0 : axis + 1;
}
constexpr int last_axis(int axis) {
    return axis == 0 ? 2 : axis - 1;
}

/// `p` moved by `distance` along `axis`.
constexpr LatticePoint moved(LatticePoint p, int axis, std::int32_t distance) {
    p[static_cast<std::size_t>(axis)] += distance;
    return p;
}

/// Corner i of the cube of side `size` at `p`: bit k of i says low or high on axis k.
constexpr LatticePoint cube_corner(const LatticePoint& p, std::int32_t size, int i) {
    return {p[0] + (i & 1) * size, p[1] + (i >> 1 & 1) * size, p[2] + (i >> 2 & 1) * size};
}

/// A piece of a grid line between neighbouring vertices of the octree: its lower end names it, since pieces
/// do not overlap.
struct LatticeEdge {
    LatticePoint low{};
    int axis = 0;

    /// 62 bits: lower ends of edges have coordinates below 2^20.
    constexpr std::uint64_t key() const {
        return (static_cast<std::uint64_t>(low[0]) | static_cast<std::uint64_t>(low[1]) << 20 |
                static_cast<std::uint64_t>(low[2]) << 40)
                   << 2 |
               static_cast<std::uint64_t>(axis);
    }
};

}  // namespace pfgeom
