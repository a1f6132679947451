// A search in the cube of an object's frame, for a goal in the world.
#pragma once

#include "pfgeom/render/extreme.h"
#include "pfgeom/render/local_ray.h"

namespace pfgeom {

inline Extreme extreme_in(const CubePlace& place, const SurfaceCells& cells, const SearchGoal& goal,
                          double within, double accuracy, ExtremeSearch& search) {
    const SearchGoal local{goal.along ? goal.place : place.to_local(goal.place), goal.along};
    // A cost along a direction counts from the world's origin.
    const double origin = goal.along ? -dot(goal.place, place.centre) : 0;
    Extreme found = search.run(cells, local, (within - origin) / place.half, accuracy / place.half);
    found.point = place.to_world(found.point);
    found.cost = origin + found.cost * place.half;
    found.proved = origin + found.proved * place.half;
    return found;
}

}  // namespace pfgeom
