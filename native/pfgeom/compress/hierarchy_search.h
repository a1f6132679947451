// The search for the hierarchy of perturbations that takes the fewest bytes.
#pragma once

#include "pfgeom/compress/candidate.h"
#include "pfgeom/mesh/close_holes.h"

#include <functional>

namespace pfgeom {

/// Makes the object of a solid that is fitted, where it is more than that.
using Finish = std::function<void(Outcome& solid)>;

/// `closed`: the goal's mesh, or a part of it closed; the solid is fitted to it, and what becomes of it is
/// proved against the goal's. Gives up when it needs more than `most_bytes`.
std::optional<Outcome> search_hierarchy(const Goal& goal, const ClosedIsland& closed, const Finish& finish,
                                        std::size_t most_bytes, const Task& task);

}  // namespace pfgeom
