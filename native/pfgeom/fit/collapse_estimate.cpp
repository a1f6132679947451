// Source: Garland, Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997.
#include "pfgeom/fit/collapse_estimate.h"

#include "pfgeom/fit/collapse_mesh.h"
#include "pfgeom/fit/plane_quadric.h"

#include <cmath>
#include <cstdint>
#include <queue>

namespace pfgeom {
namespace {

class QuickCollapser {
  public:
    QuickCollapser(const TriangleMesh& mesh, const Task& task)
        : mesh_(mesh), task_(task), quadrics_(plane_quadrics(mesh_)), moved_(mesh_.vertex_count(), 0) {
        for (std::size_t v = 0; v < mesh_.vertex_count(); ++v)
            left_ += mesh_.faces_at(static_cast<std::int32_t>(v)).empty() ? 0U : 1U;
        for (const auto& [u, v] : mesh_.edges()) propose(u, v);
    }

    // Collapses until the next one is above the limit; returns the vertices left.
    std::size_t run(double limit) {
        while (!queue_.empty() && queue_.top().error <= limit) {
            const Entry top = queue_.top();
            queue_.pop();
            task_.check();
            if (top.clock >= std::max(moved_[index(top.u)], moved_[index(top.v)])) apply(top);
        }
        return left_;
    }

  private:
    struct Entry {
        double error;
        std::int32_t u, v;
        std::uint32_t clock;
        Vec3 place;
        bool operator<(const Entry& o) const {
            return error != o.error ? error > o.error
                   : u != o.u       ? u > o.u
                   : v != o.v       ? v > o.v
                                    : clock > o.clock;
        }
    };

    static std::size_t index(std::int32_t v) { return static_cast<std::size_t>(v); }

    void propose(std::int32_t u, std::int32_t v) {
        PlaneQuadric q = quadrics_[index(u)];
        q += quadrics_[index(v)];
        const Vec3 place = q.least((mesh_.point(u) + mesh_.point(v)) * 0.5);
        queue_.push({std::sqrt(q(place) / std::max(q.weight, 1e-300)), u, v, clock_, place});
    }

    void apply(const Entry& e) {
        if (!mesh_.may_collapse(e.u, e.v)) return;
        mesh_.patch_of_collapse(e.u, e.v, e.place, patch_);
        if (!mesh_.keeps_orientation(patch_)) return;
        mesh_.collapse(e.u, e.v, patch_);
        --left_;
        quadrics_[index(e.v)] += quadrics_[index(e.u)];
        moved_[index(e.u)] = moved_[index(e.v)] = ++clock_;
        for (const std::int32_t w : mesh_.neighbours(e.v)) propose(std::min(e.v, w), std::max(e.v, w));
    }

    CollapseMesh mesh_;
    const Task& task_;
    std::vector<PlaneQuadric> quadrics_;
    std::vector<std::uint32_t> moved_;  // clock of a vertex's last move
    std::priority_queue<Entry> queue_;
    std::uint32_t clock_ = 0;
    std::size_t left_ = 0;
    Patch patch_;
};

}  // namespace

std::vector<std::size_t> vertices_after_collapses(const TriangleMesh& mesh, std::span<const double> limits,
                                                  const Task& task) {
    QuickCollapser collapser(mesh, task);
    std::vector<std::size_t> left;
    for (const double limit : limits) left.push_back(collapser.run(limit));
    return left;
}

}  // namespace pfgeom
