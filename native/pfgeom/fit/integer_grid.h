// The grid that the vertices of a mesh part lie on.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/halves.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <optional>

namespace pfgeom {

struct Grid {
    Frame frame;
    int step_code = 0;
    std::optional<MirrorPlane> mirror = {};  ///< then of a mirrored part

    double step() const { return frame.half() * exp2_eighths(step_code); }
    std::array<std::int32_t, 3> nearest(const Vec3& p) const;
    /// Above the mirror's plane, if there is one: of a vertex that is not on it.
    std::array<std::int32_t, 3> nearest_above(const Vec3& p) const;
    Vec3 point(const std::array<std::int32_t, 3>& q) const;
    /// The coarsest grid with a step of at most `step` (and not so fine that the codec could not take it).
    static Grid around(const Box& box, double step);
};

/// The plane of few binary digits that is no farther than `error` from the one that is asked for, in the
/// frame's cube.
MirrorPlane short_plane(const Frame& frame, const AxisPlane& plane, double error);

/// A flat part whose vertices are rounded to the grid.
Object part_on_grid(const TriangleMesh& mesh, const Grid& grid);

}  // namespace pfgeom
