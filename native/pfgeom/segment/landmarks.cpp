#include "pfgeom/segment/landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pfgeom {
namespace {

// Of the radius: shorter ones say little about a direction; nearer ones are taken for each other.
constexpr double kShortest = 0.2, kAlike = 1e-3;
// The second is as far from the line of the first as that.
constexpr double kLeastSine = 0.3;
// Corners are sharper than edges, edges than what is round, and other tessellations of a shape have its
// corners too: at least so much of what the sharpest vertex has.
constexpr double kSharp = 0.9;
constexpr std::size_t kMostTried = 64;  // second ones, each against all vertices

// 1 - |Σ angle · normal| / Σ angle of the faces around each vertex: 0 where it is flat, 0.29 at the edge of
// a cube, 0.42 at its corner.
std::vector<double> sharpness_of(const TriangleMesh& mesh) {
    std::vector<Vec3> sum(mesh.vertices.size());
    std::vector<double> weight(mesh.vertices.size(), 0);
    for (const Triangle& t : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 u = normalized(mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]]);
            const Vec3 v = normalized(mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[i]]);
            // Half the chord of the angle: additive enough, and without an arc cosine.
            const double angle = norm(u - v) / 2;
            const auto at = static_cast<std::size_t>(t[i]);
            sum[at] += angle * normalized(cross(u, v));
            weight[at] += angle;
        }
    }
    std::vector<double> sharpness(mesh.vertices.size(), 0);
    for (std::size_t v = 0; v < sum.size(); ++v) {
        if (weight[v] > 0) sharpness[v] = 1 - norm(sum[v]) / weight[v];
    }
    return sharpness;
}

// The vertices that may be landmarks.
std::vector<Vec3> corners_of(const TriangleMesh& mesh, const std::vector<Vec3>& from_centroid,
                             double radius) {
    const std::vector<double> sharpness = sharpness_of(mesh);
    const auto is_long = [&](std::size_t v) { return norm(from_centroid[v]) > kShortest * radius; };
    double sharpest = 0;
    for (std::size_t v = 0; v < sharpness.size(); ++v) {
        if (is_long(v)) sharpest = std::max(sharpest, sharpness[v]);
    }
    std::vector<Vec3> corners;
    for (std::size_t v = 0; v < sharpness.size(); ++v) {
        if (is_long(v) && sharpness[v] >= kSharp * sharpest) corners.push_back(from_centroid[v]);
    }
    return corners;
}

// The one whose length the fewest others have; of equally rare ones the longest.
Vec3 rarest_length(const std::vector<Vec3>& points, double alike) {
    std::vector<double> lengths;
    for (const Vec3& p : points) lengths.push_back(norm(p));
    std::sort(lengths.begin(), lengths.end());
    Vec3 best;
    std::ptrdiff_t least = 0;
    for (const Vec3& p : points) {
        const double r = norm(p);
        const auto count = std::upper_bound(lengths.begin(), lengths.end(), r + alike) -
                           std::lower_bound(lengths.begin(), lengths.end(), r - alike);
        const bool rarer = least == 0 || count < least || (count == least && r > norm(best) + alike);
        if (rarer) least = count, best = p;
    }
    return best;
}

double sine_between(const Vec3& a, const Vec3& b) {
    return norm(cross(a, b)) / (norm(a) * norm(b));
}

// Beside `first`, the one that the fewest others equal in length and in angle to it.
std::optional<Vec3> rarest_beside(const Vec3& first, const std::vector<Vec3>& points, double alike) {
    std::optional<Vec3> best;
    std::size_t least = 0;
    const Vec3 along = normalized(first);
    const std::size_t stride = (points.size() + kMostTried - 1) / kMostTried;
    for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(stride, 1)) {
        const Vec3& p = points[i];
        if (sine_between(first, p) < kLeastSine) continue;
        const auto count =
            static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Vec3& q) {
                return std::abs(norm(q) - norm(p)) < alike && std::abs(dot(q - p, along)) < alike;
            }));
        if (!best || count < least) least = count, best = p;
    }
    return best;
}

}  // namespace

std::optional<Landmarks> find_landmarks(const TriangleMesh& mesh, const Vec3& centroid) {
    Landmarks found;
    std::vector<Vec3> points;
    for (const Vec3& v : mesh.vertices) {
        points.push_back(v - centroid);
        found.radius = std::max(found.radius, norm(points.back()));
    }
    const double alike = kAlike * found.radius;
    const std::vector<Vec3> corners = corners_of(mesh, points, found.radius);
    if (corners.empty()) return {};
    found.first = rarest_length(corners, alike);
    std::optional<Vec3> second = rarest_beside(found.first, corners, alike);
    if (!second) {
        std::erase_if(points, [&](const Vec3& p) { return norm(p) <= kShortest * found.radius; });
        second = rarest_beside(found.first, points, alike);
    }
    if (!second) return {};
    found.second = *second;
    return found;
}

}  // namespace pfgeom
