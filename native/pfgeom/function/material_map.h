// Which material the surface has where: a small decision tree over space for each object, its questions
// planes, its leaves materials. On the surface of a set tree it can be one such tree for each quadric, so
// that borders which are creases cost nothing.
#pragma once

#include "pfgeom/base/box.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pfgeom {

constexpr int kMaxMaterialDepth = 96;
constexpr int kMostPlaneBits = 15;

/// A leaf, or a plane relative to the cell that the cuts above leave: with the cell's centre c and half of
/// its longest side h, the high side is where
///     (x - c)[axis] + (tilt[0] (x - c)[axis + 1] + tilt[1] (x - c)[axis + 2]) / 2^bits >= h · offset /
///     2^bits.
/// A plane without tilt is a cut: it bounds the cells of its children.
struct MaterialNode {
    std::int32_t material = 0;  ///< of a leaf
    std::uint8_t axis = 0, bits = 0;
    std::array<std::int32_t, 2> tilt{};  ///< |tilt| <= 2^bits
    std::int32_t offset = 0;             ///< |offset| < 2^bits, three times that if the plane is tilted
    std::int32_t high = -1, low = -1;    ///< -1: a leaf
    Vec3 normal;                         ///< derived: the high side is where dot(normal, x) >= level
    double level = 0;

    bool leaf() const { return high < 0; }
    bool is_cut() const { return tilt[0] == 0 && tilt[1] == 0; }
    friend bool operator==(const MaterialNode&, const MaterialNode&) = default;
};

/// Depth first, the high child first; node 0 is the root.
struct MaterialTree {
    std::vector<MaterialNode> nodes;
    friend bool operator==(const MaterialTree&, const MaterialTree&) = default;
};

/// Of an object, in its frame's cube.
struct Paint {
    /// One for the whole surface; or, of a set tree, one for each of its quadrics.
    std::vector<MaterialTree> trees;
    bool by_quadric = false;
    friend bool operator==(const Paint&, const Paint&) = default;
};

struct MaterialMap {
    std::vector<std::string> names;  ///< as many as there are materials; UTF-8, may be empty
    /// For each object one that all its copies share, or one for each copy. Empty, as `names`: no materials.
    std::vector<std::vector<Paint>> objects;

    bool empty() const { return objects.empty(); }
    friend bool operator==(const MaterialMap&, const MaterialMap&) = default;
};

/// The cell of a tree's root, and those of the children of a plane in its cell.
Box root_cell();
Box high_cell(const MaterialNode& plane, const Box& cell);
Box low_cell(const MaterialNode& plane, const Box& cell);
/// Fills what is derived.
void derive(MaterialNode& plane, const Box& cell);

std::int32_t material_at(const MaterialTree& tree, const Vec3& p);

/// Of one material everywhere.
Paint plain_paint(std::int32_t material);

}  // namespace pfgeom
