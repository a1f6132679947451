#include "pfgeom/report/quadrature.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/mesh/angle.h"
#include "pfgeom/mesh/sample.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr double kTouching = 1e-9;  // times the size of the coordinates: faces that share a point

Vec3 face_normal(const TriangleMesh& mesh, std::int32_t face) {
    const auto& [a, b, c] = mesh.faces[face];
    return cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
}

// Between `normal` and the face at the closest point. Where several faces meet there, as on an edge, the face
// that fits best: which one of them counts as closest is chance.
double smallest_angle(const Vec3& normal, const TriangleMesh& to, const std::vector<std::int32_t>& faces) {
    double smallest = 180;
    for (const std::int32_t face : faces) {
        const Vec3 other = face_normal(to, face);
        if (other == Vec3{}) continue;
        smallest = std::min(smallest, angle_between(normal, other) * kDegrees);
    }
    return smallest;
}

struct Measured {
    double squared_distance = 0, angle = 0;
};

std::vector<Measured> measure(const SurfaceSamples& samples, const TriangleMesh& from, const TriangleMesh& to,
                              const Bvh& to_bvh, const Task& task) {
    const Box box = to_bvh.bounds();
    const double touching = kTouching * norm(max(box.hi, -box.lo));
    std::vector<Measured> measured(samples.points.size());
    parallel_chunks(measured.size(), 1024, task, [&](std::size_t begin, std::size_t end) {
        std::vector<std::int32_t> faces;
        std::int32_t hint = -1;
        for (std::size_t i = begin; i < end; ++i) {
            task.check();
            const ClosestPoint closest = to_bvh.closest(samples.points[i], Box::kInf, hint);
            hint = closest.face;
            faces.assign(1, closest.face);
            to_bvh.faces_within(closest.point, touching, faces);
            measured[i] = {closest.squared_distance,
                           smallest_angle(face_normal(from, samples.faces[i]), to, faces)};
        }
    });
    return measured;
}

}  // namespace

DistanceMeans mean_distances(const TriangleMesh& from, const TriangleMesh& to, const Bvh& to_bvh,
                             std::size_t samples, std::uint64_t seed, const Task& task) {
    const SurfaceSamples points = sample_surface(from, samples, seed);
    const std::vector<Measured> measured = measure(points, from, to, to_bvh, task);
    DistanceMeans means;
    std::vector<double> distances;
    distances.reserve(samples);
    double squares = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double distance = std::sqrt(measured[i].squared_distance);
        distances.push_back(distance);
        squares += measured[i].squared_distance;
        means.mean += distance;
        means.normal_mean_deg += measured[i].angle;
        if (distance > means.max) means.max = distance, means.worst = points.points[i];
    }
    const auto n = static_cast<double>(samples);
    means.rms = std::sqrt(squares / n);
    means.mean /= n;
    means.normal_mean_deg /= n;
    const auto rank = distances.begin() + static_cast<std::ptrdiff_t>(0.99 * n);
    std::nth_element(distances.begin(), rank, distances.end());
    means.p99 = *rank;
    return means;
}

}  // namespace pfgeom
