// The quadric of a region in integers: the family, the units and the integers that take the fewest bits while
// the surface stays where it must. Source: set-partitioned closed-loop quantisation as in audio and video
// coders. Departure: the scale of a quadric is free, so it is searched as well.
#pragma once

#include "pfgeom/function/set_tree.h"
#include "pfgeom/segment/power_sums.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pfgeom {

/// A point of the surface and how far the quadric may pass from it. Of a separator also which way it has to
/// fall: its outward normal is within a cosine of 0.9 of `outwards`, unless that is zero.
struct CheckPoint {
    /// near: within `limit`, to first order; else the quadric must be positive or negative at the point.
    enum class Kind : std::uint8_t { near, positive, negative };
    Vec3 point;
    double limit = 0;
    Kind kind = Kind::near;
    Vec3 outwards = {};
};

struct QuantisedQuadric {
    TreeQuadric quadric;
    double bits = 0;  ///< estimate
    /// Of a separator (tree_seams.h): the quadrics, rising, along whose seams it runs. Empty: a surface of
    /// the part.
    std::vector<std::pair<std::int32_t, std::int32_t>> between = {};
};

/// Does the quadric pass all points within their limits (to first order)?
bool passes(const Quadric& q, const std::vector<CheckPoint>& points);

/// The same; the point that does not comes first in the list, where it is found sooner the next time.
bool passes_in_turn(const Quadric& q, std::vector<CheckPoint>& points);

/// Estimated bits of one integer.
double integer_bits(std::int32_t n);

/// Estimated bits of a quadric's family, units and integers.
double estimated_bits(const TreeQuadric& q);

/// The cheapest quadric that passes all points, or nothing. `scales`: how many scales are tried. Reorders
/// `points`: those that decide come first.
std::optional<QuantisedQuadric> quantise(const PowerSums& sums, std::vector<CheckPoint>& points,
                                         int resolution, int scales, double normal_weight);

/// The quadric as it is, rounded to the finest units.
TreeQuadric round_finely(const Quadric& q, int resolution);

}  // namespace pfgeom
