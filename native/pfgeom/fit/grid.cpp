#include "pfgeom/fit/grid.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/base/sort_unique.h"
#include "pfgeom/fit/patch_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pfgeom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMendingRounds = 4;
// With more vertices than this over the limit the grid is too coarse, and mending would only cost time (igea
// at 1e-3: 4,986 bytes at 0.01, 4,778 at 0.02 and 0.05).
constexpr double kHopeless = 0.05;
constexpr std::size_t kMostTrials = 10;
// Nor is there hope with more vertices than these open after a round (half a bracket at a quarter of its
// tolerance: 185 of 214, and minutes).
constexpr std::size_t kFewOpen = 16, kFacesPerOpen = 8;
// A coarser lattice must leave some of the limit to the neighbours.
constexpr double kSlack = 0.92;
// A move this much over the limit may be saved by the bulges; beyond, they are not tried.
constexpr double kMayBeBent = 2;
constexpr int kCoarsest = 5;  // lattices of 2^5 steps

using GridPoint = std::array<std::int32_t, 3>;

Vec3 normal_at(const CollapseMesh& mesh, std::int32_t v) {
    Vec3 sum;
    for (const std::int32_t f : mesh.faces_at(v)) {
        const auto t = mesh.corners(f);
        sum += cross(t[1] - t[0], t[2] - t[0]);
    }
    return normalized(sum);
}

// Of a vertex and its neighbours.
std::vector<std::int32_t> faces_around(const CollapseMesh& mesh, std::int32_t v) {
    std::vector<std::int32_t> faces = mesh.faces_at(v);
    for (const std::int32_t w : mesh.neighbours(v))
        faces.insert(faces.end(), mesh.faces_at(w).begin(), mesh.faces_at(w).end());
    return faces;
}

std::size_t steepest(const Vec3& n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    return x > y && x > z ? 0 : y > z ? 1 : 2;
}

class Snapper {
  public:
    Snapper(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Grid& grid)
        : mesh_(mesh), error_(error), limits_(limits), grid_(grid) {}

    /// Returns whether the limit is kept.
    bool snap(std::int32_t v, double limit) {
        Vec3 normal = normal_at(mesh_, v);
        if (mesh_.on_mirror(v)) normal[grid_.mirror->axis] = 0;
        for (int level = kCoarsest; level >= 0; --level) {
            if (try_level(v, normal, level, level > 0 ? kSlack * limit : limit)) return true;
        }
        take_least_evil(v);
        return false;
    }

    /// If it is over the limit: moves it, and its neighbours that are then. Returns those that were.
    std::vector<std::int32_t> mend(std::int32_t v, double limit) {
        if (holds(v, limit)) return {};
        take_least_evil(v);
        std::vector<std::int32_t> moved{v};
        for (const std::int32_t w : mesh_.neighbours(v)) {
            if (holds(w, limit)) continue;
            take_least_evil(w);
            moved.push_back(w);
        }
        return moved;
    }

  private:
    bool holds(std::int32_t v, double limit) {
        mesh_.patch_of_move(v, mesh_.point(v), patch_);
        return error_.forward(patch_, limit) <= limit && error_.stays_near(patch_, limits_.backward);
    }
    // On the mirror's plane a vertex stays, and any other off it.
    GridPoint nearest(std::int32_t v, const Vec3& p) const {
        GridPoint q = grid_.nearest_above(p);
        if (mesh_.on_mirror(v)) q[static_cast<std::size_t>(grid_.mirror->axis)] = 0;
        return q;
    }
    Vec3 fitted_place() const {
        if (!patch_.curved()) return error_.fitted(patch_);
        Patch fitted = patch_;
        error_.refit(fitted, true);
        return fitted.triangles[0][0];
    }
    // Leaves the patch of the move in patch_. The bulges of a curved one follow where it would cost more than
    // `enough` without. Infinite if it is over `most`.
    double cost(std::int32_t v, const GridPoint& q, double enough, double most) {
        mesh_.patch_of_move(v, grid_.point(q), patch_);
        if (!mesh_.keeps_orientation(patch_)) return kInfinity;
        const double plain = error_.forward(patch_, patch_.curved() ? kMayBeBent * most : most);
        if (!patch_.curved() || plain <= enough || plain == kInfinity) return plain;
        bent_ = patch_;
        error_.refit(bent_, false);
        const double bent = error_.forward(bent_, most);
        if (!(bent < plain)) return plain;
        std::swap(patch_, bent_);
        return bent;
    }
    // The patch that cost() left.
    bool take(std::int32_t v) {
        error_.commit(patch_);
        mesh_.move(v, patch_);
        return true;
    }

    // The lattice point next to the vertex, at the height above it where the surface is, and one step to each
    // side.
    bool try_level(std::int32_t v, const Vec3& normal, int level, double limit) {
        const Vec3 p = mesh_.point(v);
        GridPoint q = nearest(v, p);
        const std::size_t w = steepest(normal);
        double slide = 0;
        for (const std::size_t axis : {(w + 1) % 3, (w + 2) % 3}) {
            const std::int32_t pitch = 1 << level;
            q[axis] =
                static_cast<std::int32_t>(std::floor(static_cast<double>(q[axis]) / pitch + 0.5)) * pitch;
            slide += normal[static_cast<int>(axis)] *
                     (grid_.point(q)[static_cast<int>(axis)] - p[static_cast<int>(axis)]);
        }
        Vec3 on_surface = p;
        if (normal[static_cast<int>(w)] != 0)
            on_surface[static_cast<int>(w)] -= slide / normal[static_cast<int>(w)];
        const std::int32_t height = grid_.nearest(on_surface)[w];
        struct Candidate {
            double cost = kInfinity;
            std::int32_t height = 0;
        };
        std::array<Candidate, 3> candidates;
        std::size_t count = 0;
        double most = limit;
        for (const std::int32_t h : {height, height - 1, height + 1}) {
            q[w] = h;
            const double c = cost(v, q, most, most);
            if (!(c <= most)) continue;
            candidates[count] = {c, h};
            if (patch_.curved())
                ++count;
            else
                most = c;  // of flat patches the second best is not worth its time: the last one stays
        }
        std::sort(candidates.begin(), candidates.end(),
                  [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
        for (const Candidate& candidate : candidates) {
            if (candidate.cost == kInfinity) break;
            q[w] = candidate.height;
            cost(v, q, limit, limit);
            if (error_.stays_near(patch_, limits_.backward * limit / limits_.forward)) return take(v);
        }
        return false;
    }

    // Nothing near the vertex keeps the limit now: the least evil, until its neighbours have come onto the
    // grid. What is near: around its place, and around the one that would fit best.
    void take_least_evil(std::int32_t v) {
        struct Candidate {
            double cost;
            GridPoint q;
        };
        mesh_.patch_of_move(v, mesh_.point(v), patch_);
        std::vector<Candidate> candidates;
        std::vector<double> least;  // of their costs those that count, as a heap
        const auto cost_of = [&](const GridPoint& q) {
            const auto known = std::ranges::find(candidates, q, &Candidate::q);
            if (known != candidates.end()) return known->cost;
            return cost(v, q, limits_.forward, least.size() < kMostTrials ? kInfinity : least.front());
        };
        for (const GridPoint& middle : {nearest(v, mesh_.point(v)), nearest(v, fitted_place())}) {
            for (std::int32_t i = 0; i < 27; ++i) {
                const GridPoint q{middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1};
                candidates.push_back({cost_of(q), q});
                least.push_back(candidates.back().cost);
                std::push_heap(least.begin(), least.end());
                if (least.size() <= kMostTrials) continue;
                std::pop_heap(least.begin(), least.end());
                least.pop_back();
            }
        }
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
        Candidate best{kInfinity, nearest(v, mesh_.point(v))};
        candidates.resize(kMostTrials);  // the way back is dear to measure
        for (const auto& [forward, q] : candidates) {
            if (!(forward < best.cost) || best.cost <= limits_.forward) break;
            cost(v, q, limits_.forward, kInfinity);
            const double most = std::min(best.cost, 3 * limits_.backward);
            const bool by_max = limits_.metric == Metric::max;
            const double backward = error_.backward(patch_, most, by_max ? forward : most);
            const double worst = by_max ? std::max(forward, backward) : forward;
            if (backward < kInfinity && worst < best.cost) best = {worst, q};
        }
        cost(v, best.q, limits_.forward, kInfinity);
        take(v);
    }

    CollapseMesh& mesh_;
    CollapseError& error_;
    const CollapseLimits& limits_;
    const Grid& grid_;
    Patch patch_, bent_;
};

}  // namespace

std::vector<std::int32_t> vertices_over(const CollapseMesh& mesh, const CollapseError& error,
                                        const CollapseLimits& limits, const Task& task) {
    constexpr std::size_t kChunk = 16;
    const std::vector<std::int32_t> faces = mesh.faces_left();
    std::vector<std::uint8_t> over(faces.size(), 0);
    parallel_chunks(faces.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
        Patch patch;
        for (std::size_t i = begin; i < end; ++i) {
            mesh.patch_of_face(faces[i], patch);
            const bool near = error.forward(patch, limits.forward) <= limits.forward &&
                              error.stays_near(patch, limits.backward);
            over[i] = near ? 0 : 1;
        }
    });
    std::vector<std::int32_t> vertices;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Triangle& t = mesh.face(faces[i]);
        if (over[i] != 0) vertices.insert(vertices.end(), t.begin(), t.end());
    }
    sort_unique(vertices);
    return vertices;
}

bool snap_vertices(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Grid& grid,
                   bool persistent, const Task& task) {
    const std::vector<std::int32_t> vertices = mesh.vertices_left();
    const std::size_t count = vertices.size();
    PatchLoop loop(mesh, error);
    for (const std::int32_t v : vertices) loop.add(mesh.faces_at(v));
    std::vector<std::uint8_t> failed(count, 0);
    loop.run(task, [&](std::size_t i) {
        double limit = limits.forward;  // rms: an even share of what the sum may still rise
        if (limits.metric == Metric::rms) {
            limit =
                (limit * limit - error.mean_square()) * error.total_weight() / static_cast<double>(count - i);
        }
        failed[i] = Snapper(mesh, error, limits, grid).snap(vertices[i], limit) ? 0 : 1;
    });
    if (limits.metric != Metric::max) return true;
    const auto failures = static_cast<double>(std::ranges::count(failed, 1));
    const bool fine = failures <= 4 + kHopeless * static_cast<double>(count);
    if (!fine && !persistent) return false;
    error.look(kLook);
    mend_vertices(mesh, error, limits, grid, vertices_over(mesh, error, limits, task), task);
    return true;
}

std::vector<std::int32_t> mend_vertices(CollapseMesh& mesh, CollapseError& error,
                                        const CollapseLimits& limits, const Grid& grid,
                                        std::vector<std::int32_t> open, const Task& task) {
    for (int round = 0; round < kMendingRounds && !open.empty(); ++round) {
        PatchLoop loop(mesh, error);
        for (const std::int32_t v : open) loop.add(faces_around(mesh, v));
        std::vector<std::vector<std::int32_t>> moved(open.size());
        loop.run(task, [&](std::size_t i) {
            moved[i] = Snapper(mesh, error, limits, grid).mend(open[i], limits.forward);
        });
        open.clear();
        for (const std::vector<std::int32_t>& some : moved) open.insert(open.end(), some.begin(), some.end());
        sort_unique(open);
        if (open.size() > kFewOpen + mesh.face_count() / kFacesPerOpen) break;
    }
    return open;
}

}  // namespace pfgeom
