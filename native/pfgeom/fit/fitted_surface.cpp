#include "pfgeom/fit/fitted_surface.h"

#include "pfgeom/base/error.h"

namespace pfgeom {
namespace {

// Of the tolerance: how far the plane's short form may be from it, and what is on it.
constexpr double kPlaneError = 1.0 / 64, kOnPlane = 1.0 / 64;

}  // namespace

FittedSurface::FittedSurface(const TriangleMesh& mesh, const MeshPartOptions& options)
    : mesh_(mesh), metric_(options.metric), box_(bounds(mesh)) {
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

CollapseError FittedSurface::error(double tolerance, double spacing, const Task& task) const {
    CollapseError error(original(), metric_, tolerance, spacing, task);
    if (half_) error.start_from(*half_, task);
    return error;
}

}  // namespace pfgeom
