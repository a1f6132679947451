#include "pfgeom/report/tree_bound_side.h"

#include "pfgeom/mesh/islands.h"

#include <cmath>

namespace pfgeom {
namespace {

// Cosine between a point's offset and the normal at its closest point: below this, as it can be on the edges
// of knives, the winding number decides.
constexpr double kUndecided = 1e-4;

double orientation_of(const TriangleMesh& mesh, const Task& task) {
    MeshDefects defects;
    double volume = 0;
    for (const Island& island : find_islands(mesh, defects, task)) {
        if (!island.closed || !island.manifold || !island.oriented) return 0;
        volume += island.signed_volume;
    }
    return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

}  // namespace

SurfaceSides::SurfaceSides(const TriangleMesh& mesh, const Bvh& bvh, const Task& task)
    : mesh_(mesh), bvh_(bvh), orientation_(orientation_of(mesh, task)), distance_(mesh, bvh) {}

Vec3 SurfaceSides::normal_at(const SignedClosest& closest) const {
    return normalized(distance_.normal_at(closest.face, closest.point)) * orientation_;
}

SignedClosest SurfaceSides::at(const Vec3& p, std::int32_t hint) const {
    SignedClosest closest = distance_(p, hint);
    const double distance = std::abs(closest.distance);
    const double along = dot(p - closest.point, normal_at(closest));
    bool inside = along < 0;
    if (!(std::abs(along) > kUndecided * distance)) inside = orientation_ * bvh_.winding_number(p) > 0.5;
    closest.distance = inside ? distance : -distance;
    return closest;
}

}  // namespace pfgeom
