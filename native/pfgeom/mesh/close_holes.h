// An island with borders, closed.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>

namespace pfgeom {

/// Its own faces come first, as they were; behind them a fan for each border, around a new vertex in its
/// middle. `island`: oriented, and a manifold, so that no two borders meet.
struct ClosedIsland {
    TriangleMesh mesh;
    std::size_t own_faces = 0;
    bool fit_closing = true;  ///< is a function to follow, roughly, what closes it?
};
ClosedIsland close_holes(const TriangleMesh& island);

}  // namespace pfgeom
