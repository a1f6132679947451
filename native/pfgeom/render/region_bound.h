// A lower bound of what is looked for over a region of a cell, and the point that comes with it.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/render/condition.h"

#include <limits>
#include <span>

namespace pfgeom {

/// What is looked for: the point nearest to `place`, or the one farthest along the direction `place`.
struct SearchGoal {
    Vec3 place;
    bool along = false;

    /// Of a point: its distance, or how far it lies against the direction. Less is better.
    double cost(const Vec3& y) const { return along ? -dot(place, y) : norm(y - place); }
    /// The point of the box with the least cost.
    Vec3 best_of(const Box& box) const;
    double least(const Box& box) const { return cost(best_of(box)); }
};

/// The conditions F >= 0 on a cell, as models around one of its points.
struct LocalCondition {
    double value = 0;
    Vec3 gradient, upper;
    double multiplier = 0;
};

/// F's own expansion, or that of its negative.
LocalCondition local_condition(const Expansion& expansion, bool positive);

struct RegionBound {
    double cost = 0;  ///< no point of the region in the cell has a lower one; infinity: there is none
    Vec3 point;       ///< the minimiser of the Lagrangian; in the cell, perhaps not in the region
};

/// By duality: for any multipliers >= 0 the least Lagrangian over the cell is a bound; it is separable, so
/// exact. The multipliers are improved one after the other. `at`: where the models are around.
RegionBound bound_region(const SearchGoal& goal, const Box& cell, const Vec3& at,
                         std::span<LocalCondition> conditions);

}  // namespace pfgeom
