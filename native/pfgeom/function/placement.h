// Copies of an object: similarities of the world, and such as files hold, in integers.
#pragma once

#include "pfgeom/base/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pfgeom {

/// A rotation (or mirror), uniform scale and translation of the world.
struct Similarity {
    double scale = 1;
    std::array<Vec3, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Vec3 translation;

    Vec3 apply(const Vec3& p) const {
        return scale * Vec3{dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)} + translation;
    }
    Vec3 apply_inverse(const Vec3& p) const { return turn_back((p - translation) / scale); }
    /// The transposed rotation: of gradients and directions.
    Vec3 turn_back(const Vec3& d) const { return d.x * rows[0] + d.y * rows[1] + d.z * rows[2]; }
    Vec3 turn(const Vec3& d) const { return {dot(rows[0], d), dot(rows[1], d), dot(rows[2], d)}; }

    friend bool operator==(const Similarity&, const Similarity&) = default;
};

/// First `inner`, then `outer`.
Similarity composed(const Similarity& outer, const Similarity& inner);
Similarity inverse_of(const Similarity& s);

/// How a copy lies, in the steps of its list. Every direction that a turn can have to a given fineness has
/// nearly the same bits, and quarter turns and no turn are exact.
struct Placement {
    /// A quaternion (w, x, y, z) of any length. Its component of the largest magnitude (the first of equal
    /// ones) is Placements::turn_steps.
    std::array<std::int32_t, 4> turn{1, 0, 0, 0};
    bool mirrored = false;                ///< x to -x, before it is turned
    std::int32_t scale = 1;               ///< over Placements::scale_steps
    std::array<std::int32_t, 3> place{};  ///< of the frame's centre, from the list's origin

    friend bool operator==(const Placement&, const Placement&) = default;
};

/// In normal form (`normalise`), so that equal copies have equal integers.
struct Placements {
    static constexpr std::int32_t kMostSteps = 1 << 20;  // of turns and scales
    static constexpr std::int32_t kMostScale = 1 << 26, kMostPlace = 1 << 30;

    std::int32_t turn_steps = 1, scale_steps = 1;
    int step_code = 0;                     ///< places are in steps of 2^(step_code / 8), in the world's units
    std::array<std::int64_t, 3> origin{};  ///< in steps
    std::vector<Placement> list;           ///< by rising x of their places

    bool empty() const { return list.empty(); }
    /// Of the object with this centre, which turns and grows about it.
    Similarity similarity(std::size_t i, const Vec3& centre) const;

    friend bool operator==(const Placements&, const Placements&) = default;
};

/// The integer quaternion nearest to a rotation, with the largest component `steps`.
std::array<std::int32_t, 4> quantise_turn(const std::array<Vec3, 3>& rows, std::int32_t steps);
/// The rotation of a quaternion (w, x, y, z) of any length but zero; its rows are orthonormal to rounding.
std::array<Vec3, 3> rotation_of(const std::array<double, 4>& turn);

/// Sorted, the origin where the least places are 0, steps without a common divisor. What the copies are stays
/// the same, bit for bit.
void normalise(Placements& placements);
/// What is wrong with it: ranges, normal form. Empty: nothing.
std::string find_flaw(const Placements& placements);

}  // namespace pfgeom
