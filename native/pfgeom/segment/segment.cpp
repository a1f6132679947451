// Best-first merging of regions on their sums.
// Source: the paper's section "Method", bottom-up; the order as in hierarchical face clustering (Attene,
// Falcidieno, Spagnuolo, "Hierarchical mesh segmentation based on fitting primitives", 2006). Departures: one
// primitive, the general quadric; each pair of neighbours is one candidate whose cost is brought up to date
// only when it comes up, so that a merge does not touch the other neighbours; regions that do not touch are
// merged as well.
#include "pfgeom/segment/segment.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/union_find.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <queue>
#include <tuple>

namespace pfgeom {
namespace {

// Joining what lies apart has never left fewer than a third of the regions.
constexpr std::size_t kMostJoined = 4;

// Two regions as they were when the cost was found: regions only grow, so the same size means the same
// regions.
struct Candidate {
    double cost = 0;
    double rank = 0;  // among equal costs: the lower one first
    std::size_t size = 0;
    std::int32_t a = 0, b = 0;

    friend bool operator>(const Candidate& x, const Candidate& y) {
        return std::tie(x.cost, x.rank, x.size, x.a, x.b) > std::tie(y.cost, y.rank, y.size, y.a, y.b);
    }
};
using Queue = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

std::optional<Candidate> candidate(const RegionSet& regions, std::int32_t a, std::int32_t b) {
    const std::optional<double> cost = regions.cost(a, b);
    if (!cost) return {};
    return Candidate{*cost, 0, regions.size(a) + regions.size(b), std::min(a, b), std::max(a, b)};
}

std::vector<std::pair<std::int32_t, std::int32_t>> neighbours(const TriangleMesh& mesh) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        for (std::size_t i = 1; i < uses.size(); ++i) pairs.emplace_back(uses[0].face(), uses[i].face());
    });
    return pairs;
}

// As candidate(), but of those that cost about the same the farthest come first. Beyond the outermost of
// parallel planes there is nothing, whereas a pair of a pocket's floor and the bottom below is negative above
// the floor and below the bottom, and takes another plane to tell these apart (a box with a pocket, askew:
// 155 bytes, and 100 so). Not always better: hub_gear of examples/parts.py has 141 bytes, and 167 so.
std::optional<Candidate> outermost_first(const RegionSet& regions, std::int32_t a, std::int32_t b) {
    constexpr double kSteps = 40;  // of kCostSteps: what rounded coordinates differ in shall not decide
    std::optional<Candidate> c = candidate(regions, a, b);
    if (!c) return {};
    c->cost = std::floor(c->cost / kSteps);
    c->rank = -squared_norm(regions.centroid(a) - regions.centroid(b));
    return c;
}

// Costs of many pairs, in their order.
template <class PairAt, class CandidateOf>
std::vector<Candidate> candidates(const RegionSet& regions, std::size_t count, const PairAt& pair_at,
                                  const CandidateOf& candidate_of, const Task& task) {
    constexpr std::size_t kChunk = 1024;
    std::vector<std::vector<Candidate>> found((count + kChunk - 1) / kChunk);
    parallel_chunks(count, kChunk, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b] = pair_at(i);
            if (const auto c = candidate_of(regions, a, b)) found[begin / kChunk].push_back(*c);
        }
    });
    std::vector<Candidate> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
}

// Takes candidates, cheapest first, until none is left; `take` may add others.
template <class Take>
void work_off(Queue& queue, const Task& task, const Take& take) {
    for (std::size_t step = 0; !queue.empty(); ++step) {
        if (step % 64 == 0) task.check();
        const Candidate next = queue.top();
        queue.pop();
        take(next);
    }
}

void merge_neighbours(const TriangleMesh& mesh, RegionSet& regions, UnionFind& roots, const Task& task) {
    const auto pairs = neighbours(mesh);
    Queue queue({}, candidates(
                        regions, pairs.size(), [&](std::size_t i) { return pairs[i]; }, candidate, task));
    work_off(queue, task, [&](const Candidate& next) {
        const std::int32_t a = roots.find(next.a), b = roots.find(next.b);
        if (a == b) return;
        if (regions.size(a) + regions.size(b) != next.size) {
            if (const auto now = candidate(regions, a, b)) queue.push(*now);
        } else if (regions.merge(a, b)) {
            roots.join(a, b);
        }
    });
}

// Regions that need not touch: the largest against all.
void merge_apart(RegionSet& regions, std::vector<std::int32_t> alive, const SegmentOptions& options,
                 const Task& task) {
    const auto candidate_of = options.outermost_first ? outermost_first : candidate;
    std::ranges::stable_sort(
        alive, [&](std::int32_t a, std::int32_t b) { return regions.area(a) > regions.area(b); });
    const std::size_t hosts = std::min(options.hosts, alive.size());
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::size_t i = 0; i < hosts; ++i) {
        for (std::size_t j = i + 1; j < alive.size(); ++j) pairs.emplace_back(alive[i], alive[j]);
    }
    Queue queue({}, candidates(
                        regions, pairs.size(), [&](std::size_t i) { return pairs[i]; }, candidate_of, task));
    work_off(queue, task, [&](const Candidate& next) {
        if (regions.size(next.a) == 0 || regions.size(next.b) == 0) return;
        if (regions.size(next.a) + regions.size(next.b) != next.size || !regions.merge(next.a, next.b, true))
            return;
        std::erase(alive, next.b);
        const auto with_next = [&](std::size_t i) { return std::pair(next.a, alive[i]); };
        for (const Candidate& c :
             candidates(regions, alive.size(), with_next, candidate_of, quiet(task, 1))) {
            if (c.a != c.b) queue.push(c);
        }
    });
}

}  // namespace

std::vector<Region> segment(const TriangleMesh& mesh, const SegmentOptions& options, const Task& task) {
    RegionSet regions(mesh, options.tolerance, options.most_misalignment);
    UnionFind roots(mesh.faces.size());
    for (const WholeQuadric& whole : options.whole) {
        regions.unite(whole);
        for (const std::int32_t f : whole.faces) roots.join(whole.faces[0], f);
    }
    for (const ExactPatch& patch : options.exact) {
        const auto taken = [&](std::int32_t f) { return regions.size(f) != 1 || !regions.merges(f); };
        if (std::ranges::any_of(patch.faces, taken) || !regions.unite(patch.faces)) continue;
        for (const std::int32_t f : patch.faces) roots.join(patch.faces[0], f);
    }
    merge_neighbours(mesh, regions, roots, task);
    std::vector<std::int32_t> alive;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (regions.merges(static_cast<std::int32_t>(f))) alive.push_back(static_cast<std::int32_t>(f));
    }
    if (alive.size() / kMostJoined > options.most_regions) return {};
    merge_apart(regions, std::move(alive), options, task);
    regions.refine_all(task);
    std::vector<Region> result = regions.take();
    if (result.size() > options.most_regions) result.clear();
    return result;
}

}  // namespace pfgeom
