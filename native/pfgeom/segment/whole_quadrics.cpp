#include "pfgeom/segment/whole_quadrics.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/segment/ellipsoid.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pfgeom {
namespace {

constexpr std::size_t kMost = 1000;  // quadrics: each is tried on every face
constexpr int kSteps = 8;            // 384 points of each: what rounding changes is a quadric itself
constexpr double kSame = 1.0 / 16;  // of the tolerance: patches whose vertices miss a quadric by less are its
constexpr double kAligned = 0.9;    // cosine between a face and the quadric that takes it

// To first order. Gradients of a flat ellipsoid are far from equal, but none is zero on it.
double distance_to(const Quadric& q, const Vec3& p) {
    return std::abs(q.value(p)) / std::max(norm(q.gradient(p)), 1e-9);
}

bool passes_vertices(const Quadric& q, const TriangleMesh& mesh, const std::vector<std::int32_t>& faces,
                     double limit) {
    return std::ranges::all_of(faces, [&](std::int32_t f) {
        return std::ranges::all_of(mesh.faces[f],
                                   [&](std::int32_t v) { return distance_to(q, mesh.vertices[v]) <= limit; });
    });
}

// The error of the quadric on the face, if it could take it.
std::optional<double> error_on(const Quadric& q, const TriangleMesh& mesh, std::int32_t face,
                               const Vec3& normal, double limit) {
    const auto points = check_points(mesh, face);
    const Vec3 g = q.gradient(points[6]);
    if (-dot(g, normal) < kAligned * norm(g)) return {};
    double worst = 0;
    for (const Vec3& p : points) {
        worst = std::max(worst, distance_to(q, p));
        if (worst > limit) return {};
    }
    return worst;
}

class Finder {
  public:
    Finder(const TriangleMesh& mesh, const SignedDistance& distance, double tolerance, double tube,
           const Task& task)
        : mesh_(mesh), distance_(distance), tolerance_(tolerance), tube_(tube), task_(task) {}

    std::vector<WholeQuadric> run(std::span<const ExactPatch> exact) {
        collect(exact);
        find_hidden();
        claim_faces();
        return std::move(found_);
    }

  private:
    // Ellipsoids of exact patches, one for all patches that lie on it.
    void collect(std::span<const ExactPatch> exact) {
        std::vector<ExactPatch> patches(exact.begin(), exact.end());
        std::erase_if(patches, [](const ExactPatch& p) { return !ellipsoid_of(p.quadric); });
        std::ranges::stable_sort(patches, std::greater<>{},
                                 [](const ExactPatch& p) { return p.faces.size(); });
        for (ExactPatch& patch : patches) {
            task_.check();
            const auto host = std::ranges::find_if(found_, [&](const WholeQuadric& w) {
                return passes_vertices(w.quadric, mesh_, patch.faces, kSame * tolerance_);
            });
            if (host != found_.end()) {
                host->faces.insert(host->faces.end(), patch.faces.begin(), patch.faces.end());
            } else if (found_.size() < kMost) {
                found_.push_back({of_mean_slope(patch), std::move(patch.faces), {}});
            }
        }
    }

    // Gradients are about 1 on the surface, as everywhere.
    Quadric of_mean_slope(const ExactPatch& patch) const {
        double slope = 0;
        for (const std::int32_t f : patch.faces)
            slope += norm(patch.quadric.gradient(mesh_.vertices[mesh_.faces[f][0]]));
        Quadric q = patch.quadric;
        for (double& c : q.c) c *= static_cast<double>(patch.faces.size()) / slope;
        return q;
    }

    // Drops quadrics whose hidden part is not on one side of the surface.
    void find_hidden() {
        parallel_chunks(found_.size(), 1, task_, [&](std::size_t i, std::size_t) { hide(found_[i]); });
        std::erase_if(found_, [](const WholeQuadric& w) { return w.faces.empty(); });
    }

    void hide(WholeQuadric& whole) const {
        bool inside = false, outside = false;
        std::int32_t hint = whole.faces[0];
        for (const Vec3& p : spread_points(*ellipsoid_of(whole.quadric), kSteps)) {
            const SignedClosest closest = distance_(p, hint);
            hint = closest.face;
            if (std::abs(closest.distance) <= tube_) continue;
            (closest.distance > 0 ? inside : outside) = true;
            whole.hidden.push_back({p, normalized(-whole.quadric.gradient(p)),
                                    tube_ + std::abs(closest.distance), closest.distance > 0});
        }
        if (inside && outside) whole.faces.clear();
    }

    // Each face that the patches leave goes to the quadric that is closest to it.
    void claim_faces() {
        std::vector<std::int32_t> owner(mesh_.faces.size(), -1);
        for (std::size_t i = 0; i < found_.size(); ++i) {
            for (const std::int32_t f : found_[i].faces) owner[f] = static_cast<std::int32_t>(i);
        }
        parallel_chunks(mesh_.faces.size(), 1024, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) {
                if (owner[f] < 0) owner[f] = closest_to(static_cast<std::int32_t>(f));
            }
        });
        for (WholeQuadric& whole : found_) whole.faces.clear();
        for (std::size_t f = 0; f < owner.size(); ++f) {
            if (owner[f] >= 0)
                found_[static_cast<std::size_t>(owner[f])].faces.push_back(static_cast<std::int32_t>(f));
        }
    }

    std::int32_t closest_to(std::int32_t face) const {
        std::int32_t best = -1;
        double least = tolerance_;
        for (std::size_t i = 0; i < found_.size(); ++i) {
            const auto error = error_on(found_[i].quadric, mesh_, face, distance_.face_normal(face), least);
            if (!error || (best >= 0 && *error >= least)) continue;
            best = static_cast<std::int32_t>(i);
            least = *error;
        }
        return best;
    }

    const TriangleMesh& mesh_;
    const SignedDistance& distance_;
    double tolerance_, tube_;
    const Task& task_;
    std::vector<WholeQuadric> found_;
};

}  // namespace

std::vector<WholeQuadric> find_whole_quadrics(const TriangleMesh& mesh, const SignedDistance& distance,
                                              std::span<const ExactPatch> exact, double tolerance,
                                              double tube, const Task& task) {
    return Finder(mesh, distance, tolerance, tube, task).run(exact);
}

}  // namespace pfgeom
