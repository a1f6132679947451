// Vertices that come in the same order tell at once. Else two landmarks of the pattern are looked for among
// the vertices; each pair that could be them gives a placement, which is tried at a few points, improved by
// least squares and then asked of all.
// Source: Besl, McKay, "A method for registration of 3-D shapes", IEEE PAMI 14(2), 1992. Departure: where
// both have as many vertices, points are drawn to the nearest vertex, and one round is enough.
#include "pfgeom/segment/laid_on.h"

#include "pfgeom/segment/point_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pfgeom {
namespace {

// Of the pattern's radius, what landmarks may miss at most: more would fit any vertex.
constexpr double kLandmarkShare = 0.01;
// Rounds with all vertices; where the vertices are those of the pattern the first is exact.
constexpr int kRounds = 6;
// Of a scale other than 1, and of the tolerance: what it must change to be one.
constexpr double kRigidShare = 0.25;
constexpr std::size_t kProbes = 24;
constexpr int kMostPlacements = 2000;
// Of the tolerance: a placement as good as that needs no better one.
constexpr double kGood = 0.1;

// The turn (or reflection) that brings the directions a0, a1 to b0, b1.
std::array<Vec3, 3> turn_between(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1,
                                 bool mirrored) {
    const auto frame = [](const Vec3& u, const Vec3& v) {
        const Vec3 x = normalized(u), z = normalized(cross(u, v));
        return std::array<Vec3, 3>{x, cross(z, x), z};
    };
    const std::array<Vec3, 3> a = frame(a0, a1), b = frame(b0, b1);
    std::array<Vec3, 3> rows{};
    for (int i = 0; i < 3; ++i) {
        const double side = mirrored ? -b[2][i] : b[2][i];
        rows[static_cast<std::size_t>(i)] = b[0][i] * a[0] + b[1][i] * a[1] + side * a[2];
    }
    return rows;
}

}  // namespace

// One mesh that the pattern is laid on.
class Laying {
  public:
    Laying(const Pattern& pattern, const TriangleMesh& mesh, const SurfaceMoments& moments, double tolerance,
           const Task& task)
        : pattern_(pattern), mesh_(mesh), moments_(moments), tolerance_(tolerance), task_(task), bvh_(mesh) {
        const double radius = pattern.landmarks_ ? pattern.landmarks_->radius : 0;
        scale_ = std::sqrt(moments.area / pattern.moments_.area);
        rigid_ = std::abs(scale_ - 1) * radius <= kRigidShare * tolerance;
        if (rigid_) scale_ = 1;
        near_ = std::min(tolerance, kLandmarkShare * radius * scale_);
    }

    std::optional<Similarity> run() {
        for (const bool mirrored : {false, true}) {
            best_residual_ = tolerance_;
            by_order(mirrored);
            if (best_residual_ > kGood * tolerance_) by_landmarks(mirrored);
            if (best_) return best_;
        }
        return {};
    }

  private:
    bool same_count() const { return mesh_.vertices.size() == pattern_.mesh_.vertices.size(); }

    void by_order(bool mirrored) {
        if (!same_count()) return;
        consider(align_points(pattern_.mesh_.vertices, mesh_.vertices, mirrored, rigid_));
    }

    void by_landmarks(bool mirrored) {
        if (!pattern_.landmarks_) return;
        const auto [first, second, radius] = *pattern_.landmarks_;
        const std::vector<Vec3> firsts = vertices_at(norm(first)), seconds = vertices_at(norm(second));
        const double product = scale_ * dot(first, second) / norm(first);
        int tried = 0;
        for (const Vec3& b0 : firsts) {
            for (const Vec3& b1 : seconds) {
                task_.check();
                if (std::abs(dot(b0, b1) / norm(b0) - product) > 2 * near_) continue;
                if (++tried > kMostPlacements) return;
                Similarity s;
                s.scale = scale_;
                s.rows = turn_between(first, second, b0, b1, mirrored);
                s.translation = moments_.centroid - s.apply(pattern_.moments_.centroid);
                if (!is_near_at_probes(s)) continue;
                consider(improved(s, mirrored));
                if (best_residual_ <= kGood * tolerance_) return;
            }
        }
    }

    // Those as far from the centroid as a landmark of this length.
    std::vector<Vec3> vertices_at(double length) const {
        std::vector<Vec3> found;
        for (const Vec3& v : mesh_.vertices) {
            const Vec3 p = v - moments_.centroid;
            if (std::abs(norm(p) - scale_ * length) <= near_) found.push_back(p);
        }
        return found;
    }

    bool is_near_at_probes(const Similarity& s) const {
        const std::vector<Vec3>& vertices = pattern_.mesh_.vertices;
        const std::size_t n = std::min(kProbes, vertices.size());
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 p = s.apply(vertices[i * vertices.size() / n]);
            if (bvh_.closest(p, 2 * tolerance_ + 4 * near_).face < 0) return false;
        }
        return true;
    }

    Similarity improved(Similarity s, bool mirrored) const {
        std::vector<Vec3> to(pattern_.mesh_.vertices.size());
        for (int round = 0; round < kRounds; ++round) {
            for (std::size_t i = 0; i < to.size(); ++i) {
                task_.check();
                to[i] = goal_of(s.apply(pattern_.mesh_.vertices[i]));
            }
            s = align_points(pattern_.mesh_.vertices, to, mirrored, rigid_);
            if (same_count()) break;
        }
        return s;
    }

    // The nearest point; where the vertices are the pattern's, the nearest vertex of its face.
    Vec3 goal_of(const Vec3& p) const {
        const ClosestPoint closest = bvh_.closest(p);
        if (!same_count()) return closest.point;
        Vec3 best = closest.point;
        double least = std::numeric_limits<double>::infinity();
        for (const std::int32_t v : mesh_.faces[closest.face]) {
            const double d = squared_norm(mesh_.vertices[v] - p);
            if (d < least) least = d, best = mesh_.vertices[v];
        }
        return best;
    }

    // Keeps it if all vertices of both lie nearer to the other's surface than after the best so far.
    void consider(const Similarity& s) {
        const double residual = std::max(
            farthest(
                pattern_.mesh_.vertices, bvh_, [&s](const Vec3& p) { return s.apply(p); }, 1),
            farthest(
                mesh_.vertices, pattern_.bvh_, [&s](const Vec3& p) { return s.apply_inverse(p); }, s.scale));
        if (residual < best_residual_) best_residual_ = residual, best_ = s;
    }

    template <class Move>
    double farthest(const std::vector<Vec3>& vertices, const Bvh& from, const Move& move,
                    double scale) const {
        double most = 0;
        for (const Vec3& v : vertices) {
            task_.check();
            const ClosestPoint closest = from.closest(move(v), best_residual_ / scale);
            if (closest.face < 0) return std::numeric_limits<double>::infinity();
            most = std::max(most, closest.squared_distance);
        }
        return scale * std::sqrt(most);
    }

    const Pattern& pattern_;
    const TriangleMesh& mesh_;
    const SurfaceMoments& moments_;
    double tolerance_;
    const Task& task_;
    Bvh bvh_;
    double scale_ = 1, near_ = 0;
    bool rigid_ = true;
    std::optional<Similarity> best_;
    double best_residual_ = 0;
};

Pattern::Pattern(TriangleMesh mesh)
    : mesh_(std::move(mesh)),
      moments_(moments_of(mesh_)),
      bvh_(mesh_),
      landmarks_(find_landmarks(mesh_, moments_.centroid)) {}

std::optional<Similarity> Pattern::laid_on(const TriangleMesh& mesh, const SurfaceMoments& moments,
                                           double tolerance, const Task& task) const {
    return Laying(*this, mesh, moments, tolerance, task).run();
}

}  // namespace pfgeom
