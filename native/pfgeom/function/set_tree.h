// A closed region as a decision tree over quadrics: F(x) = S(x) >= 0 ? high : low, that is
// (S ∩ high) ∪ (¬S ∩ low), with leaves inside and outside. Creases and corners are implied by the questions;
// nothing of the boundary is stored. A union of ellipsoids is the special case in which every low side is
// another question and every high side is `inside`.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/function/quadric.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

constexpr int kMaxTreeDepth = 128;                 ///< questions on a path
constexpr int kCoarseCuts = 32, kFineCuts = 1024;  ///< positions of a cut in a cell

/// A quadric as integers in one of the families of function/quadric_family.h. Coefficients are
/// n · 2^-e with e = resolution for constants, resolution - linear_shift for linear terms and
/// resolution - linear_shift - square_shift for squares and products.
struct TreeQuadric {
    std::uint8_t family = 0;
    std::uint8_t linear_shift = 0, square_shift = 0;  ///< < 16
    std::array<std::int32_t, 10> n{};                 ///< as many as the family has, then zeros
    Quadric quadric;                                  ///< derived: what the integers mean

    friend bool operator==(const TreeQuadric&, const TreeQuadric&) = default;
};

struct TreeNode {
    enum class Kind : std::uint8_t {
        outside,
        inside,
        cut,  ///< x[axis] >= cut ? high : low
        ask   ///< quadrics[quadric] >= 0 ? high : low
    };
    Kind kind = Kind::outside;
    std::uint8_t axis = 0;
    bool fine = false;           ///< cut: position counts 1024ths of the cell, else 32nds
    std::uint16_t position = 0;  ///< cut: of the cell that the cuts above leave, from its low side; never 0
    std::int32_t quadric = -1;
    std::int32_t high = -1, low = -1;
    double cut = 0;  ///< derived, in the cube's units

    bool leaf() const { return kind == Kind::outside || kind == Kind::inside; }
    friend bool operator==(const TreeNode&, const TreeNode&) = default;
};

/// Nodes in depth-first order, the high child first; node 0 is the root. Quadrics in the order of their first
/// use. What lies outside the box is outside.
struct SetTree {
    std::uint8_t resolution = 10;               ///< the unit of constants is 2^-resolution
    std::array<std::int32_t, 3> low{}, high{};  ///< the box, in units of 2^-(resolution + 1)
    bool complement = false;                    ///< of an island whose normals point inwards
    std::vector<TreeQuadric> quadrics;
    std::vector<TreeNode> nodes;

    Box box() const;  ///< in the cube's units
    friend bool operator==(const SetTree&, const SetTree&) = default;
};

/// Is p inside? By the questions alone, as the decoder asks them; `complement` is not applied.
bool contains(const SetTree& tree, const Vec3& p);

/// Where a cut lies in its cell, and the cell that it (or a question to a quadric: all) leaves to each side.
double cut_position(const TreeNode& node, const Box& cell);
Box high_cell(const TreeNode& node, const Box& cell);
Box low_cell(const TreeNode& node, const Box& cell);

/// Fills what is derived: quadrics from their integers, cuts from their positions. The tree must be well
/// formed (function/check.h).
void derive(SetTree& tree);

}  // namespace pfgeom
