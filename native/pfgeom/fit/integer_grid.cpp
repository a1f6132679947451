#include "pfgeom/fit/integer_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfgeom {
namespace {

// Coordinates stay below 2^26, well within what the codec takes.
constexpr int kFinestCode = -8 * 26;

// Places that a nearly singular system puts far away, or nowhere, stay away: their error turns them down.
std::int32_t rounded(double x) {
    constexpr double kFar = 1 << 27;
    return static_cast<std::int32_t>(x > -kFar && x < kFar ? std::floor(x + 0.5) : kFar);
}

}  // namespace

std::array<std::int32_t, 3> Grid::nearest(const Vec3& p) const {
    Vec3 local = frame.to_local(p);
    if (mirror) local[mirror->axis] -= mirror->at;
    const Vec3 q = local / exp2_eighths(step_code);
    return {rounded(q.x), rounded(q.y), rounded(q.z)};
}

std::array<std::int32_t, 3> Grid::nearest_above(const Vec3& p) const {
    std::array<std::int32_t, 3> q = nearest(p);
    if (mirror)
        q[static_cast<std::size_t>(mirror->axis)] = std::max(q[static_cast<std::size_t>(mirror->axis)], 1);
    return q;
}

Vec3 Grid::point(const std::array<std::int32_t, 3>& q) const {
    const MeshPart part{step_code, {}, {}, 0, {}, mirror};
    return frame.to_world(part.local(q));
}

Grid Grid::around(const Box& box, double step) {
    Grid grid{Frame::around(box), 0, {}};
    while (grid.step() > step && grid.step_code > kFinestCode) --grid.step_code;
    return grid;
}

MirrorPlane short_plane(const Frame& frame, const AxisPlane& plane, double error) {
    constexpr int kMostDigits = 40;
    Vec3 world;
    world[plane.axis] = plane.at;
    const double exact = frame.to_local(world)[plane.axis];
    MirrorPlane result{plane.axis, exact};
    for (int digits = 0; digits <= kMostDigits; ++digits) {
        const double unit = std::ldexp(1.0, -digits);
        result.at = std::floor(exact / unit + 0.5) * unit;
        if (std::abs(result.at - exact) * frame.half() <= error) break;
    }
    return result;
}

Object part_on_grid(const TriangleMesh& mesh, const Grid& grid) {
    MeshPart part;
    part.step_code = grid.step_code;
    part.faces = mesh.faces;
    part.mirror = grid.mirror;
    part.positions.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) part.positions.push_back(grid.nearest(v));
    Object object;
    object.frame = grid.frame;
    object.shape = std::move(part);
    return object;
}

}  // namespace pfgeom
