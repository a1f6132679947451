#include "pfgeom/fit/target.h"

#include "pfgeom/mesh/sample.h"

#include <algorithm>

namespace pfgeom {
namespace {

double signed_volume(const TriangleMesh& mesh) {
    double six = 0;
    for (const Triangle& t : mesh.faces) {
        six += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
    }
    return six / 6;
}

// Of what closes a surface one in so many samples is kept (stanford-bunny, 2 % of whose area are holes: 3 %
// fewer bytes at 1e-4, 2 % at 2e-4). With none the surface runs off 100 tolerances at a border (at 1e-4).
constexpr std::size_t kFewer = 16;

// Not of the samples that prove the fit (seed 1), at which its error is smaller than between them: spot at an
// rms of 2e-4 was 0.96 of the tolerance at those and 1.00 at any others.
constexpr std::uint64_t kSeed = 2;

// Along a coarse Morton curve, so that neighbours in memory are neighbours in space.
std::uint32_t curve_position(const Vec3& p) {
    std::uint32_t key = 0;
    for (int b = 9; b >= 0; --b) {
        for (int d = 0; d < 3; ++d) {
            const auto v = static_cast<std::uint32_t>(std::clamp((p[d] + 1) * 512, 0.0, 1023.0));
            key = (key << 1) | ((v >> b) & 1U);
        }
    }
    return key;
}

}  // namespace

TriangleMesh in_cube(TriangleMesh mesh, const Frame& frame) {
    for (Vec3& v : mesh.vertices) v = frame.to_local(v);
    return mesh;
}

FitTarget::FitTarget(const TriangleMesh& island, std::size_t samples, std::size_t own, bool with_closing)
    : frame(Frame::around(pfgeom::bounds(island))), bvh(in_cube(island, frame)) {
    const TriangleMesh local = in_cube(island, frame);
    const Box box = pfgeom::bounds(local);
    half_extent = max(box.hi, -box.lo);
    area = surface_area(local);
    inside_out = signed_volume(local) < 0;
    const SurfaceSamples drawn = sample_surface(local, samples, kSeed);
    const std::vector<Vec3> vertex_normal = vertex_normals(local);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
    order.reserve(drawn.points.size());
    std::size_t closing = 0;
    for (std::size_t i = 0; i < drawn.points.size(); ++i) {
        const bool closes = static_cast<std::size_t>(drawn.faces[i]) >= own;
        if (closes && (!with_closing || closing++ % kFewer != 0)) continue;
        order.emplace_back(curve_position(drawn.points[i]), static_cast<std::uint32_t>(i));
    }
    std::sort(order.begin(), order.end());
    for (const auto& [key, i] : order) {
        const Triangle& t = local.faces[static_cast<std::size_t>(drawn.faces[i])];
        const Vec3& w = drawn.barycentric[i];
        const Vec3 n = w.x * vertex_normal[t[0]] + w.y * vertex_normal[t[1]] + w.z * vertex_normal[t[2]];
        points.push_back(drawn.points[i]);
        normals.push_back(normalized(inside_out ? -n : n));
    }
}

void FitTarget::add_vertices(const TriangleMesh& island) {
    const std::vector<Vec3> vertex_normal = vertex_normals(island);
    for (std::size_t i = 0; i < island.vertices.size(); ++i) {
        points.push_back(frame.to_local(island.vertices[i]));
        const Vec3 n = normalized(vertex_normal[i]);
        normals.push_back(inside_out ? -n : n);
    }
}

double FitTarget::signed_distance(const Vec3& p) const {
    const ClosestPoint c = bvh.closest(p);
    const double winding = bvh.winding_number(p);
    const bool inside = std::abs(winding) > 0.5;
    const double d = std::sqrt(c.squared_distance);
    return inside ? d : -d;
}

}  // namespace pfgeom
