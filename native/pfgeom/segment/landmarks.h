// Two vertices by which one shape can be laid on another: such as few others could be taken for.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/segment/surface_moments.h"

#include <optional>

namespace pfgeom {

/// Seen from the centroid of the area.
struct Landmarks {
    Vec3 first, second;  ///< neither of them short, nor in one line
    double radius = 0;   ///< of the farthest vertex
};

/// Nothing if all vertices lie in a line.
std::optional<Landmarks> find_landmarks(const TriangleMesh& mesh, const Vec3& centroid);

}  // namespace pfgeom
