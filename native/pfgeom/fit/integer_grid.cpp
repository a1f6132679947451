#include "pfgeom/fit/integer_grid.h"

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
    const Vec3 q = frame.to_local(p) / exp2_eighths(step_code);
    return {rounded(q.x), rounded(q.y), rounded(q.z)};
}

Vec3 Grid::point(const std::array<std::int32_t, 3>& q) const {
    const double s = exp2_eighths(step_code);  // as mesh_of (eval/mesh_part.h) has it
    return frame.to_world({q[0] * s, q[1] * s, q[2] * s});
}

Grid Grid::around(const Box& box, double step) {
    Grid grid{Frame::around(box), 0};
    while (grid.step() > step && grid.step_code > kFinestCode) --grid.step_code;
    return grid;
}

Object part_on_grid(const TriangleMesh& mesh, const Grid& grid) {
    MeshPart part;
    part.step_code = grid.step_code;
    part.faces = mesh.faces;
    part.positions.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) part.positions.push_back(grid.nearest(v));
    Object object;
    object.frame = grid.frame;
    object.shape = std::move(part);
    return object;
}

}  // namespace pfgeom
