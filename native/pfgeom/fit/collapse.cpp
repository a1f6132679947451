#include "pfgeom/fit/collapse.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/fit/collapse_ahead.h"
#include "pfgeom/fit/collapse_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// So many are looked at together. Of 8, 24 and 64 on two threads 1, 4 and 19 % were in vain on rocker-arm,
// where 17,000 that were needed made 1,900, 800 and 640 batches.
constexpr std::size_t kAhead = 24;

// Samples on large faces and edges are this many tolerances apart; at 6 the input stuck out by 17 %
// (beetle-alt).
constexpr double kSpacing = 3;
// ... but not more than some this many in all.
constexpr double kMostSamples = 2e5;

class Collapser {
  public:
    Collapser(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Task& task)
        : mesh_(mesh),
          error_(error),
          limits_(limits),
          task_(task),
          cost_(mesh, error, limits),
          moved_(mesh.vertex_count(), 0),
          changed_(mesh.vertex_count(), 0),
          ahead_(mesh.vertex_count(), [this](const Entry& e) { return measure(e); }) {}
    void run();

  private:
    using Entry = CollapseEntry;
    void propose(std::int32_t u, std::int32_t v) { queue_.push(cost_.estimate(u, v, clock_)); }
    MeasuredCollapse measure(const Entry& e) const;
    MeasuredCollapse measured(const Entry& e);
    bool is_current(const Entry& e) const;
    bool is_known(const Entry& e) const;
    bool is_harmless(const Entry& e) const { return e.harmless && !e.measured; }
    std::vector<Entry> likely_next();
    bool take(const Entry& e);
    void apply(const Entry& e, const MeasuredCollapse& found);
    void replace(const Entry& e, const Patch& patch);

    CollapseMesh& mesh_;
    CollapseError& error_;
    const CollapseLimits& limits_;
    const Task& task_;
    CollapseCost cost_;
    std::vector<std::uint32_t> moved_, changed_;  // clock of the last change of a vertex, and of its faces
    std::priority_queue<Entry> queue_;
    std::uint32_t clock_ = 0;
    CollapseAhead ahead_;
    Patch patch_;
};

// Else one of its vertices is gone, or it was proposed anew.
bool Collapser::is_current(const Entry& e) const {
    return e.clock >= std::max(moved_[static_cast<std::size_t>(e.u)], moved_[static_cast<std::size_t>(e.v)]);
}

// Its key is what it costs.
bool Collapser::is_known(const Entry& e) const {
    return e.measured && e.clock >= std::max(changed_[static_cast<std::size_t>(e.u)],
                                             changed_[static_cast<std::size_t>(e.v)]);
}

// What is known will be applied if it stays near, so that is looked at too. The patch was not kept: a flat
// one is made from its place, a curved one is found anew.
MeasuredCollapse Collapser::measure(const Entry& e) const {
    if (!is_known(e)) return cost_.measure(e.u, e.v);
    MeasuredCollapse found;
    if (mesh_.curved())
        found = cost_.measure(e.u, e.v);
    else
        mesh_.patch_of_collapse(e.u, e.v, e.place, found.patch);
    found.near = error_.stays_near(found.patch, limits_.backward);
    return found;
}

// Of the entries that come first as things are: those that are to be measured.
std::vector<CollapseEntry> Collapser::likely_next() {
    std::vector<Entry> next, looked_at;
    while (next.size() < kAhead && looked_at.size() < 2 * kAhead && !queue_.empty()) {
        const Entry e = queue_.top();
        queue_.pop();
        if (!is_current(e)) continue;
        looked_at.push_back(e);
        if (!is_harmless(e) && !ahead_.knows(e) && mesh_.may_collapse(e.u, e.v)) next.push_back(e);
    }
    for (const Entry& e : looked_at) queue_.push(e);
    return next;
}

MeasuredCollapse Collapser::measured(const Entry& e) {
    // Nothing is known ahead of what a sum may still rise by: it changes with each collapse.
    if (limits_.metric != Metric::max || thread_count(task_) == 1) return measure(e);
    if (!ahead_.knows(e)) {
        std::vector<Entry> next = likely_next();
        next.push_back(e);
        ahead_.look(next, task_);
    }
    return *ahead_.take(e);
}

// Without a look at distances. False: that will not do.
bool Collapser::take(const Entry& e) {
    mesh_.patch_of_collapse(e.u, e.v, e.place, patch_);
    if (!cost_.is_harmless(patch_)) return false;
    if (mesh_.keeps_orientation(patch_)) replace(e, patch_);
    return true;
}

void Collapser::apply(const Entry& e, const MeasuredCollapse& found) {
    if (found.near ? *found.near : error_.stays_near(found.patch, limits_.backward)) replace(e, found.patch);
}

void Collapser::replace(const Entry& e, const Patch& patch) {
    const auto u = static_cast<std::size_t>(e.u), v = static_cast<std::size_t>(e.v);
    for (const std::int32_t f : patch.before) {
        for (const std::int32_t w : mesh_.face(f)) ahead_.touch(w);
    }
    error_.commit(patch);
    mesh_.collapse(e.u, e.v, patch);
    cost_.join(e.u, e.v);
    moved_[v] = changed_[v] = ++clock_;
    moved_[u] = clock_;
    for (const std::int32_t w : mesh_.neighbours(e.v)) {
        changed_[static_cast<std::size_t>(w)] = clock_;
        propose(std::min(e.v, w), std::max(e.v, w));
    }
}

void Collapser::run() {
    for (const auto& [u, v] : mesh_.edges()) propose(u, v);
    while (!queue_.empty()) {
        const Entry top = queue_.top();
        queue_.pop();
        task_.check();
        if (!is_current(top) || !mesh_.may_collapse(top.u, top.v)) continue;
        if (is_harmless(top) && take(top)) continue;
        const MeasuredCollapse found = measured(top);
        if (is_known(top)) {
            apply(top, found);
            continue;
        }
        if (found.cost == kInfinity) continue;
        const double key = found.cost + cost_.of_length(top.u, top.v);
        if (key > top.key && !queue_.empty() && key > queue_.top().key) {
            queue_.push({key, top.u, top.v, clock_, true, false, found.patch.triangles[0][0]});
        } else {
            apply(top, found);
        }
    }
}

}  // namespace

void collapse_edges(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits,
                    const Task& task) {
    Collapser(mesh, error, limits, task).run();
}

double collapse_spacing(const TriangleMesh& original, double tolerance, double samples_of_face) {
    const double most = std::min(kMostSamples, samples_of_face * static_cast<double>(original.faces.size()));
    return std::max(kSpacing * tolerance, std::sqrt(surface_area(original) / most));
}

}  // namespace pfgeom
