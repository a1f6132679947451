#include "pfgeom/fit/collapse.h"

#include "pfgeom/fit/plane_quadric.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace pfgeom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A proposal whose error is above this share of the limit is fitted to the samples.
constexpr double kWorthFitting = 0.3;
// A proposal this much over the limit is fitted too; beyond, fitting does not save it.
constexpr double kMayBeSaved = 3;

// Share of the limit that a collapse may take, by its quadrics alone, to be done without a look at distances.
// Not at borders, whose planes count little in the mean beside a flat side (the holes below the bunny).
constexpr double kHarmless = 0.1;

class Collapser {
  public:
    Collapser(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Task& task)
        : mesh_(mesh),
          error_(error),
          limits_(limits),
          task_(task),
          quadrics_(plane_quadrics(mesh)),
          moved_(mesh.vertex_count(), 0),
          changed_(mesh.vertex_count(), 0) {}
    void run();

  private:
    struct Entry {
        double key;
        std::int32_t u, v;
        std::uint32_t clock;
        bool measured, harmless;
        Vec3 place;
        bool operator<(const Entry& o) const {
            return key != o.key ? key > o.key : u != o.u ? u > o.u : v != o.v ? v > o.v : clock > o.clock;
        }
    };
    struct Proposal {
        Vec3 place;
        double cost = kInfinity;
    };
    void propose(std::int32_t u, std::int32_t v);
    Proposal measure(std::int32_t u, std::int32_t v);
    double cost_of(const Patch& patch, double most) const;
    void improve(Patch& patch) const;
    void take(const Entry& e);
    void apply(std::int32_t u, std::int32_t v);
    void replace(std::int32_t u, std::int32_t v, const Patch& patch);
    double limit() const;
    double length_cost(std::int32_t u, std::int32_t v) const;
    bool on_border(std::int32_t v) const { return !mesh_.neighbours(v, false).empty(); }

    CollapseMesh& mesh_;
    CollapseError& error_;
    const CollapseLimits& limits_;
    const Task& task_;
    std::vector<PlaneQuadric> quadrics_;
    std::vector<std::uint32_t> moved_, changed_;  // clock of the last change of a vertex, and of its faces
    std::priority_queue<Entry> queue_;
    std::uint32_t clock_ = 0;
    Patch patch_, improved_;
};

// What a single collapse may cost.
double Collapser::limit() const {
    if (limits_.metric == Metric::max) return limits_.forward;
    return (limits_.forward * limits_.forward - error_.mean_square()) * error_.total_weight();
}

double Collapser::length_cost(std::int32_t u, std::int32_t v) const {
    const double share = 0.02 * norm(mesh_.point(u) - mesh_.point(v)) / limits_.size;
    if (limits_.metric == Metric::max) return share * limits_.forward;
    return 1e-7 * share * limits_.forward * limits_.forward * error_.total_weight();
}

void Collapser::propose(std::int32_t u, std::int32_t v) {
    PlaneQuadric q = quadrics_[static_cast<std::size_t>(u)];
    q += quadrics_[static_cast<std::size_t>(v)];
    const Vec3 place = q.least((mesh_.point(u) + mesh_.point(v)) * 0.5);
    const double rest = q(place), rms = std::sqrt(rest / std::max(q.weight, 1e-300));
    // Both in the unit of forward(): the quadrics' weights are doubled areas, counted at three corners.
    const double estimate = limits_.metric == Metric::max ? rms : rest / 6;
    const bool harmless =
        rms <= kHarmless * limits_.forward && !error_.quantised() && !on_border(u) && !on_border(v);
    queue_.push({estimate + length_cost(u, v), u, v, clock_, false, harmless, place});
}

double Collapser::cost_of(const Patch& patch, double most) const {
    return mesh_.keeps_orientation(patch) ? error_.forward(patch, most) : kInfinity;
}

void Collapser::improve(Patch& patch) const {
    if (patch.curved())
        error_.refit(patch, true);
    else
        patch.move_to(error_.fitted(patch));
}

// Leaves in patch_ what it found.
Collapser::Proposal Collapser::measure(std::int32_t u, std::int32_t v) {
    PlaneQuadric q = quadrics_[static_cast<std::size_t>(u)];
    q += quadrics_[static_cast<std::size_t>(v)];
    const double most = limit();
    const Vec3 place = error_.placed(q.least((mesh_.point(u) + mesh_.point(v)) * 0.5));
    mesh_.patch_of_collapse(u, v, place, patch_);
    if (patch_.curved()) error_.bend(patch_);
    double cost = cost_of(patch_, kMayBeSaved * most);
    if (cost > kWorthFitting * most && cost < kInfinity) {
        improved_ = patch_;
        improve(improved_);
        const double better = cost_of(improved_, std::min(cost, most));
        if (better < cost) {
            cost = better;
            std::swap(patch_, improved_);
        }
    }
    return {patch_.triangles[0][0], cost > most ? kInfinity : cost};
}

// Without a look at distances.
void Collapser::take(const Entry& e) {
    mesh_.patch_of_collapse(e.u, e.v, e.place, patch_);
    if (mesh_.keeps_orientation(patch_)) replace(e.u, e.v, patch_);
}

// What measure() left in patch_.
void Collapser::apply(std::int32_t u, std::int32_t v) {
    if (error_.stays_near(patch_, limits_.backward)) replace(u, v, patch_);
}

void Collapser::replace(std::int32_t u, std::int32_t v, const Patch& patch) {
    error_.commit(patch);
    mesh_.collapse(u, v, patch);
    quadrics_[static_cast<std::size_t>(v)] += quadrics_[static_cast<std::size_t>(u)];
    moved_[static_cast<std::size_t>(v)] = changed_[static_cast<std::size_t>(v)] = ++clock_;
    moved_[static_cast<std::size_t>(u)] = clock_;
    for (const std::int32_t w : mesh_.neighbours(v)) {
        changed_[static_cast<std::size_t>(w)] = clock_;
        propose(std::min(v, w), std::max(v, w));
    }
}

void Collapser::run() {
    for (const auto& [u, v] : mesh_.edges()) propose(u, v);
    while (!queue_.empty()) {
        const Entry top = queue_.top();
        queue_.pop();
        task_.check();
        const auto u = static_cast<std::size_t>(top.u), v = static_cast<std::size_t>(top.v);
        if (top.clock < std::max(moved_[u], moved_[v])) continue;  // gone, or proposed anew
        if (!mesh_.may_collapse(top.u, top.v)) continue;
        if (top.measured && top.clock >= std::max(changed_[u], changed_[v])) {
            if (patch_.curved())
                measure(top.u, top.v);
            else
                mesh_.patch_of_collapse(top.u, top.v, top.place, patch_);
            apply(top.u, top.v);
            continue;
        }
        if (top.harmless && !top.measured) {
            take(top);
            continue;
        }
        const Proposal found = measure(top.u, top.v);
        if (found.cost == kInfinity) continue;
        const double key = found.cost + length_cost(top.u, top.v);
        if (key > top.key && !queue_.empty() && key > queue_.top().key) {
            queue_.push({key, top.u, top.v, clock_, true, false, found.place});
        } else {
            apply(top.u, top.v);
        }
    }
}

}  // namespace

void collapse_edges(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits,
                    const Task& task) {
    Collapser(mesh, error, limits, task).run();
}

void relax_vertices(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits,
                    const Task& task) {
    Patch patch;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const auto v = static_cast<std::int32_t>(i);
        if (mesh.faces_at(v).empty()) continue;
        task.check();
        mesh.patch_of_move(v, mesh.point(v), patch);
        const double before = error.forward(patch, kInfinity);
        if (patch.curved())
            error.refit(patch, true);
        else
            patch.move_to(error.fitted(patch));
        if (!mesh.keeps_orientation(patch) || !(error.forward(patch, before) < before)) continue;
        if (!error.stays_near(patch, limits.backward)) continue;
        error.commit(patch);
        mesh.move(v, patch);
    }
}

}  // namespace pfgeom
