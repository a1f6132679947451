// What a surface is like as a whole, whatever way it is turned: area, volume, how far it spreads.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <array>

namespace pfgeom {

struct SurfaceMoments {
    double area = 0;
    Vec3 centroid;                   ///< of the area
    std::array<Vec3, 3> axes;        ///< principal axes about it, in no particular order
    std::array<double, 3> spread{};  ///< rising principal moments ∫ (x·axis)² dA about it
    double volume = 0;               ///< signed; of a closed surface

    /// The moments that do not change under similarities: spread / area².
    double shape(int i) const { return spread[static_cast<std::size_t>(i)] / (area * area); }
};

SurfaceMoments moments_of(const TriangleMesh& mesh);

}  // namespace pfgeom
