// The surface's sheets within one leaf of the octree, and what joins them to those of other leaves.
#pragma once

#include "pfgeom/polygonize/octree.h"

#include <vector>

namespace pfgeom {

/// A sheet's use of a crossed edge. The four quadrants about an edge along axis a, with u and v the next
/// axes, are (-u,-v), (+u,-v), (+u,+v), (-u,+v): counter-clockwise seen from +a.
struct Crossing {
    LatticeEdge edge;
    std::int32_t length = 0;     ///< of the edge
    std::int32_t sheet = 0;      ///< within the leaf
    std::uint8_t quadrants = 0;  ///< bit q: the leaf fills quadrant q about the edge
    bool rising = false;         ///< outside at the low end, inside at the high end
    bool own = false;            ///< the leaf has the edge as one of its twelve, undivided
    Vec3 point;                  ///< where the surface crosses, by linear interpolation
};

/// One of several pieces of surface in the same face between two leaves. It joins the sheets of the leaves at
/// the crossings a and b; `direction` d of an edge is the half plane between its quadrants d and d+1.
struct FacePiece {
    LatticeEdge a, b;
    std::uint8_t a_direction = 0, b_direction = 0;
    std::int32_t size = 0;  ///< of the face
    Vec3 point;
};

struct LeafSheets {
    std::int32_t count = 0;
    std::vector<Crossing> crossings;
    std::vector<FacePiece> pieces;  ///< of faces with more than one piece of surface
};

/// Where the surface crosses an edge with the values `low` and `high` at its ends, by linear interpolation.
Vec3 crossing_point(const CubeField& field, const LatticeEdge& edge, std::int32_t length, double low,
                    double high);

/// Sheets of `leaf`, whatever the sizes of its neighbours.
void find_sheets(const Octree& octree, const OctreeNode& leaf, LeafSheets& sheets);

}  // namespace pfgeom
