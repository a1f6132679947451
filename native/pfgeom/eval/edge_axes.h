// The axes that the bulges of a mesh part are measured along. They depend on the places of the vertices and
// on which faces there are, but not on the order of either, and are the same bits everywhere.
#pragma once

#include "pfgeom/base/vec.h"
#include "pfgeom/function/edges_of_faces.h"
#include "pfgeom/function/model.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

struct EdgeAxes {
    Vec3 normal;             ///< unit vector across the edge: the mean of its faces' normals
    Vec3 sideways;           ///< unit vector across both
    Vec3 along;              ///< unit vector; zero if the edge has no length
    std::int32_t faces = 0;  ///< at the edge; of a mirrored part with the images of those on its plane
    /// Cosine of the angle between the normals of its two faces; 1 if it has not two that agree in direction.
    double fold = 1;
};

/// Of each edge of `part`, in steps. Where the halves of a mirrored part are joined the normal is in the
/// plane.
std::vector<EdgeAxes> edge_axes(const MeshPart& part, const EdgesOfFaces& edges);

}  // namespace pfgeom
