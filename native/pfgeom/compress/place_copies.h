// The coarsest integers that say where the copies of an object lie.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/function/placement.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pfgeom {

struct PlacedCopies {
    Placements placements;
    std::vector<std::size_t> order;  ///< which of the given places each placement is
};

/// No point of the box is moved by more than `error` by the rounding; it turns about `centre`. Of all steps
/// that keep it, those with the fewest bits. Empty placements if it would take finer ones than files hold.
PlacedCopies place_copies(std::span<const Similarity> places, const Box& box, const Vec3& centre,
                          double error);

}  // namespace pfgeom
