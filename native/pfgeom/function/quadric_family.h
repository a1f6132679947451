// The families of quadrics that trees are written in: linear subspaces of the ten coefficients, so that a
// plane, a cylinder along an axis or a sphere takes no more integers than it has parameters. The scale of a
// quadric is free, so each has one integer more than its surface has degrees of freedom (axis planes: none).
#pragma once

#include "pfgeom/function/quadric.h"
#include "pfgeom/function/set_tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace pfgeom {

/// Families that are alike but for the choice of axes.
enum class FamilyKind : std::uint8_t {
    axis_plane,  ///< ±x + K; the integer of the direction is ±1 and has no unit
    plane,
    round,       ///< a cylinder along an axis, or a sphere
    revolution,  ///< around an axis, or a conic cylinder along one
    general      ///< axes-parallel, or all ten coefficients
};

struct QuadricFamily {
    std::string_view name;
    FamilyKind kind;
    std::uint8_t size;                    ///< integers
    std::array<std::uint16_t, 10> terms;  ///< of integer i: bit j is set if it is coefficient j of A B … I K

    /// Degree of the terms that integer i stands for: squares and products first, the constant last.
    int degree(int i) const {
        const unsigned mask = terms[static_cast<std::size_t>(i)];
        return (mask & 0x03FU) != 0 ? 2 : (mask & 0x1C0U) != 0 ? 1 : 0;
    }
    bool has_squares() const { return degree(0) == 2; }
    bool has_linear_shift() const { return kind != FamilyKind::axis_plane; }
};

constexpr std::size_t kQuadricFamilies = 16;
constexpr std::uint8_t kMostShift = 15;                      ///< of linear_shift and square_shift
constexpr std::uint8_t kMostResolution = 26;                 ///< of a tree
constexpr std::int32_t kMostQuadricInteger = (1 << 26) - 1;  ///< absolute

/// The simplest first.
std::span<const QuadricFamily, kQuadricFamilies> quadric_families();

/// What the integers mean; exact. The family must exist.
Quadric expand(const TreeQuadric& quadric, int resolution);

}  // namespace pfgeom
