#include "pfgeom/fit/fitted_surface.h"

#include "pfgeom/base/error.h"

namespace pfgeom {
namespace {

// Of the tolerance: how far the plane's short form may be from it, and what is on it.
constexpr double kPlaneError = 1.0 / 64, kOnPlane = 1.0 / 64;
// Of a face, in what is used of the tolerance: steps of the grid are up to 0.8 of that. The rods of
// thingi-58011 at 2e-4 are strips of 5 by 690 tolerances; a plain limit of the aspect ratio left them no
// move, and their vertices came onto the grid up to 3 tolerances off. 1, 2 and 4: 3,582, 3,644 and 3,636
// faces there; elsewhere it hardly tells.
constexpr double kSafeHeight = 2;

}  // namespace

FittedSurface::FittedSurface(const TriangleMesh& mesh, const MeshPartOptions& options)
    : mesh_(mesh), metric_(options.metric), goal_(options.tolerance * options.share), box_(bounds(mesh)) {
    if (!options.mirror) return;
    const Frame frame = Frame::around(box_);
    mirror_ = short_plane(frame, *options.mirror, kPlaneError * options.tolerance);
    const Grid grid{frame, 0, mirror_};
    plane_ = AxisPlane{mirror_->axis, grid.point({})[mirror_->axis]};
    const double near = kOnPlane * options.tolerance;
    half_ = half_above(mesh, *plane_, near);
    if (half_->faces.empty()) throw InvalidInput("nothing of the mesh is above the plane of its mirror");
    both_ = *half_;
    append(half_above(mirrored(mesh, *plane_), *plane_, near), both_);
}

Grid FittedSurface::grid(double step) const {
    Grid grid = Grid::around(box_, step);
    grid.mirror = mirror_;
    return grid;
}

CollapseMesh FittedSurface::start(bool curved) const {
    return CollapseMesh(half_ ? *half_ : mesh_, curved, plane_, kSafeHeight * goal_);
}

CollapseError FittedSurface::error(double tolerance, double spacing, const Task& task) const {
    CollapseError error(original(), metric_, tolerance, spacing, task);
    if (half_) error.start_from(*half_, task);
    return error;
}

}  // namespace pfgeom
