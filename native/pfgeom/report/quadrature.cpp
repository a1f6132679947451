#include "pfgeom/report/quadrature.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/mesh/angle.h"
#include "pfgeom/mesh/sample.h"

#include <algorithm>
#include <utility>

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
    bool smooth = false;
};

bool is_smooth(const Vec3& p, const Vec3& closest, const CreaseZone& zone) {
    return zone.creases != nullptr && !zone.creases->within(p, zone.reach) &&
           !zone.creases->within(closest, zone.reach);
}

double p99_of(std::vector<double>& values) {
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size()));
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
}

NormalAngles summary(std::vector<double> angles) {
    NormalAngles all;
    if (angles.empty()) return all;
    for (const double angle : angles) {
        all.mean += angle;
        all.max = std::max(all.max, angle);
    }
    all.mean /= static_cast<double>(angles.size());
    all.p99 = p99_of(angles);
    return all;
}

std::vector<Measured> measure(const SurfaceSamples& samples, const TriangleMesh& from, const TriangleMesh& to,
                              const Bvh& to_bvh, const CreaseZone& zone, const Task& task) {
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
                           smallest_angle(face_normal(from, samples.faces[i]), to, faces),
                           is_smooth(samples.points[i], closest.point, zone)};
        }
    });
    return measured;
}

}  // namespace

DistanceMeans mean_distances(const TriangleMesh& from, const TriangleMesh& to, const Bvh& to_bvh,
                             const CreaseZone& zone, std::size_t samples, std::uint64_t seed,
                             const Task& task) {
    const SurfaceSamples points = sample_surface(from, samples, seed);
    const std::vector<Measured> measured = measure(points, from, to, to_bvh, zone, task);
    DistanceMeans means;
    std::vector<double> distances, angles, smooth_angles;
    distances.reserve(samples);
    angles.reserve(samples);
    double squares = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double distance = std::sqrt(measured[i].squared_distance);
        distances.push_back(distance);
        squares += measured[i].squared_distance;
        means.mean += distance;
        angles.push_back(measured[i].angle);
        if (measured[i].smooth) smooth_angles.push_back(measured[i].angle);
        if (distance > means.max) means.max = distance, means.worst = points.points[i];
    }
    const auto n = static_cast<double>(samples);
    means.rms = std::sqrt(squares / n);
    means.mean /= n;
    means.p99 = p99_of(distances);
    means.normals = summary(std::move(angles));
    means.smooth_normals = summary(std::move(smooth_angles));
    return means;
}

}  // namespace pfgeom
