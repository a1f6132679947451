// Quadrics of which not only the visible patch is known: a tessellated ellipsoid's vertices tell all of it.
// One that lies within the part, but for its patch, is an operand of a union; one that lies outside it is
// cut off, or cuts the part off. Either way it can be asked anywhere in space, as long as its hidden part
// stays on its side of the surface when it is rounded.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/quadric.h"
#include "pfgeom/mesh/signed_distance.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/segment/exact_patches.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// A point of a quadric away from the part's surface. If it is inside the part, the quadric may fall as near
/// as it likes but not rise beyond `room`; outside, the other way round.
struct HiddenPoint {
    Vec3 point;
    Vec3 normal;  ///< where the quadric falls
    double room = 0;
    bool inside = false;
};

struct WholeQuadric {
    Quadric quadric;                  ///< positive inside the part
    std::vector<std::int32_t> faces;  ///< that it serves, rising
    std::vector<HiddenPoint> hidden;
};

/// By falling number of exact vertices. `distance` and the exact patches are the mesh's. `tolerance`: of the
/// faces that a quadric may take; `tube`: how far from the surface a point may be on the wrong side.
std::vector<WholeQuadric> find_whole_quadrics(const TriangleMesh& mesh, const SignedDistance& distance,
                                              std::span<const ExactPatch> exact, double tolerance,
                                              double tube, const Task& task = {});

}  // namespace pfgeom
