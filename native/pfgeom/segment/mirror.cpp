// Source: Chen, Medioni, "Object modelling by registration of multiple range images", 1992: least squares
// between points and the tangent planes at their nearest points, again and again. Departures: what is looked
// for is not a motion but the plane of a reflection, the surface is laid on itself, and the farthest tenth
// does not count. Begun at planes through the centroid of the area, which a plane of symmetry goes through.
#include "pfgeom/segment/mirror.h"

#include "pfgeom/base/cholesky.h"
#include "pfgeom/mesh/sample.h"
#include "pfgeom/segment/surface_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

// A plane is judged by so many points of the surface, of which the farthest tenth does not count: what is not
// symmetric must not bend the plane of the rest.
constexpr std::size_t kSamples = 600;
constexpr double kTrimmed = 0.9;
constexpr std::uint64_t kSeed = 20181;
// Shares of the diagonal: farther images tell nothing, and a plane whose images are farther than the second
// before it is improved is none.
constexpr double kFarthest = 0.05, kHopeless = 0.02;
// Of the samples, that show whether a plane is hopeless, and that are to be on each side of it: a surface
// that lies in a plane is its own image too, but has no half.
constexpr std::size_t kFew = 60;
constexpr double kLeastSide = 0.1;
// Steps end when they take off less than a hundredth.
constexpr int kSteps = 8;
constexpr double kWorthwhile = 0.99;
// An axis is the normal unless it makes the trimmed distance this many times as large (and more than a share
// of `most`): files of 1e-3 diagonals' rounding, planes of exact models.
constexpr double kAxisFactor = 1.2, kAxisShare = 1.0 / 32;
constexpr double kNearAxis = 0.99;  // the cosine
// Middles of faces may be so much farther from their images than vertices: halves that are triangulated each
// in its own way differ there (spot).
constexpr double kMiddles = 3;

class MirrorSearch {
  public:
    MirrorSearch(const TriangleMesh& mesh, const Bvh& bvh, double most)
        : mesh_(mesh),
          bvh_(bvh),
          most_(most),
          moments_(moments_of(mesh)),
          size_(bvh.bounds().diagonal()),
          samples_(sample_surface(mesh, kSamples, kSeed).points) {}

    std::optional<Mirror> run(const Task& task) {
        struct Found {
            double distance;
            Mirror mirror;
        };
        std::vector<Found> found;
        for (const Vec3& normal : normals()) {
            task.check();
            Mirror m{normal, dot(normal, moments_.centroid), 0};
            if (distance(m, kFew) > kHopeless * size_) continue;
            const double d = improved(m, false);
            if (d <= most_ && divides(m)) found.push_back({d, m});
        }
        std::ranges::stable_sort(found, {}, &Found::distance);
        for (auto& [d, mirror] : found) {
            prefer_axis(mirror, d);
            if (measure(mirror, task)) return mirror;
        }
        return {};
    }

  private:
    // Of the coordinate planes, of the planes between them, and across the axes of inertia.
    std::vector<Vec3> normals() const {
        std::vector<Vec3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        normals.insert(normals.end(), moments_.axes.begin(), moments_.axes.end());
        for (const double sign : {1.0, -1.0}) {
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 n;
                n[axis] = std::sqrt(0.5);
                n[(axis + 1) % 3] = sign * n[axis];
                normals.push_back(n);
            }
        }
        return normals;
    }

    // The distance of an image that nine in ten do not exceed, by so many of the samples.
    double distance(const Mirror& m, std::size_t count = kSamples) const {
        std::vector<double> distances;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3& p = samples_[i * samples_.size() / count];
            distances.push_back(bvh_.closest(m.image(p), kFarthest * size_).squared_distance);
        }
        const auto at =
            distances.begin() + static_cast<std::ptrdiff_t>(kTrimmed * static_cast<double>(count));
        std::nth_element(distances.begin(), at, distances.end());
        return std::sqrt(*at);
    }

    bool divides(const Mirror& m) const {
        std::ptrdiff_t above = 0, below = 0;
        for (const Vec3& p : samples_) {
            const double h = dot(m.normal, p) - m.at;
            above += h > most_ ? 1 : 0;
            below += h < -most_ ? 1 : 0;
        }
        return static_cast<double>(std::min(above, below)) >= kLeastSide * kSamples;
    }

    // Steps while they pay; the distance that is left.
    double improved(Mirror& mirror, bool fixed) const {
        double d = distance(mirror);
        for (int i = 0; i < kSteps; ++i) {
            Mirror next = mirror;
            improve(next, fixed, d);
            const double better = distance(next);
            if (!(better < d)) break;
            mirror = next;
            const bool go_on = better < kWorthwhile * d;
            d = better;
            if (!go_on) break;
        }
        return d;
    }

    // One step of least squares over the angle of the plane, unless it is fixed, and its place. With
    // h = n·p - d the image of p misses the plane m·(x - q) = 0 at its nearest point q by e = m·(q - p +
    // 2hn), and de = 2 (((m·n) p + h m)·dn - (m·n) dd).
    void improve(Mirror& mirror, bool fixed, double farthest) const {
        if (!(farthest <= kFarthest * size_)) return;
        const Vec3 n = mirror.normal;
        const Vec3 u = across(n), v = cross(n, u);
        const std::size_t unknowns = fixed ? 1 : 3;
        Matrix10 a{};
        Vector10 b{};
        for (const Vec3& sample : samples_) {
            const ClosestPoint found = bvh_.closest(mirror.image(sample), farthest);
            if (found.face < 0) continue;
            const Vec3 m = normal_of(found.face), p = (sample - moments_.centroid) / size_;
            const double h = (dot(n, sample) - mirror.at) / size_;
            const double missed = dot(m, found.point - mirror.image(sample)) / size_, mn = dot(m, n);
            const Vec3 turn = mn * p + h * m;
            const std::array<double, 3> row{-2 * mn, 2 * dot(turn, u), 2 * dot(turn, v)};
            for (std::size_t i = 0; i < unknowns; ++i) {
                for (std::size_t j = 0; j < unknowns; ++j) a[i][j] += row[i] * row[j];
                b[i] -= row[i] * missed;
            }
        }
        // What a turned surface leaves open stays as it is.
        for (std::size_t i = 0; i < unknowns; ++i) a[i][i] += 1e-9 * kSamples;
        const Vector10 x = solve_factorised(factorise(a, unknowns), b, unknowns);
        const Vec3 turned = normalized(n + u * x[1] + v * x[2]);
        const double place = mirror.at - dot(n, moments_.centroid) + x[0] * size_;  // from the centroid
        mirror.normal = turned;
        mirror.at = dot(turned, moments_.centroid) + place;
    }

    void prefer_axis(Mirror& mirror, double least) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(mirror.normal[axis]) < kNearAxis) continue;
            Mirror straight{{}, 0, 0};
            straight.normal[axis] = 1;
            straight.at = dot(straight.normal, moments_.centroid);
            if (improved(straight, true) <= std::max(kAxisFactor * least, kAxisShare * most_))
                mirror = straight;
        }
    }

    // Vertices alone do not tell: the rims of a hole lie on the flat sides that have none.
    bool measure(Mirror& mirror, const Task& task) const {
        double worst = 0;
        const auto is_near = [&](const Vec3& p) {
            task.check();
            const ClosestPoint found = bvh_.closest(mirror.image(p), most_);
            if (found.face >= 0) worst = std::max(worst, found.squared_distance);
            return found.face >= 0;
        };
        const auto middle_is_near = [&](const Triangle& t) {
            task.check();
            const auto at = [&](std::size_t k) { return mesh_.vertices[static_cast<std::size_t>(t[k])]; };
            return bvh_.closest(mirror.image((at(0) + at(1) + at(2)) / 3), kMiddles * most_).face >= 0;
        };
        const bool holds = std::all_of(mesh_.vertices.begin(), mesh_.vertices.end(), is_near) &&
                           std::all_of(mesh_.faces.begin(), mesh_.faces.end(), middle_is_near);
        mirror.deviation = std::sqrt(worst);
        return holds;
    }

    static Vec3 across(const Vec3& n) {
        const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
        Vec3 axis;
        axis[x <= y && x <= z ? 0 : y <= z ? 1 : 2] = 1;
        return normalized(cross(n, axis));
    }

    Vec3 normal_of(std::int32_t face) const {
        const Triangle& t = mesh_.faces[static_cast<std::size_t>(face)];
        const auto at = [&](std::size_t k) { return mesh_.vertices[static_cast<std::size_t>(t[k])]; };
        return normalized(cross(at(1) - at(0), at(2) - at(0)));
    }

    const TriangleMesh& mesh_;
    const Bvh& bvh_;
    double most_;
    SurfaceMoments moments_;
    double size_;
    std::vector<Vec3> samples_;
};

}  // namespace

std::optional<Mirror> find_mirror(const TriangleMesh& mesh, const Bvh& bvh, double most, const Task& task) {
    if (mesh.faces.empty() || !(surface_area(mesh) > 0)) return {};
    return MirrorSearch(mesh, bvh, most).run(task);
}

}  // namespace pfgeom
