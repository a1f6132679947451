// The sheets of a leaf without smaller neighbours, which most leaves are: a table by the signs at its corners
// of what leaf_surface.cpp finds.
#pragma once

#include <array>
#include <cstdint>

namespace pfgeom {

/// A crossed edge of a leaf.
struct PlainCrossing {
    std::uint8_t low = 0, high = 0;  ///< its ends: corners of the leaf
    std::uint8_t axis = 0;
    std::uint8_t quadrant = 0;  ///< that the leaf fills about the edge
    std::uint8_t sheet = 0;     ///< within the leaf
};

struct PlainLeaf {
    std::array<PlainCrossing, 12> crossing{};
    std::uint8_t crossings = 0;
    std::uint8_t sheets = 0;
    bool ambiguous = false;  ///< a face has four crossings: the signs do not say how they are joined
};

/// In the order of find_sheets.
const PlainLeaf& plain_leaf(std::uint8_t inside);

}  // namespace pfgeom
