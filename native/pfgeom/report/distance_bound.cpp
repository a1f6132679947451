// The search in rounds: groups of faces, each depth first, with budgets that grow from round to round, so
// that memory stays small, what one group finds helps the others, and no result depends on the number of
// threads.
#include "pfgeom/report/distance_bound.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/report/distance_search.h"

namespace pfgeom {
namespace {

constexpr std::size_t kGroup = 256;                // faces that are searched together
constexpr std::int64_t kFirstBudget = 2 * kGroup;  // queries of a group in the first round; then doubled

std::vector<ClosestPoint> closest_to_vertices(const TriangleMesh& from, const Bvh& to, const Task& task) {
    std::vector<char> used(from.vertices.size());
    for (const Triangle& face : from.faces) {
        for (const std::int32_t v : face) used[v] = 1;
    }
    std::vector<ClosestPoint> closest(from.vertices.size());
    parallel_chunks(closest.size(), 1024, task, [&](std::size_t begin, std::size_t end) {
        std::int32_t hint = -1;
        for (std::size_t v = begin; v < end; ++v) {
            task.check();
            if (!used[v]) continue;
            closest[v] = to.closest(from.vertices[v], std::numeric_limits<double>::infinity(), hint);
            hint = closest[v].face;
        }
    });
    return closest;
}

void raise(DistanceBound& known, double distance, const Vec3& point) {
    if (distance > known.max) known.max = distance, known.worst = point;
}

// Rounds until all groups are done, a point refutes what is to be certified, or the work is spent.
void search_in_rounds(std::vector<DistanceSearch>& groups, DistanceBound& known, std::int64_t work,
                      const DistanceProblem& problem) {
    std::vector<DistanceSearch*> open;
    for (DistanceSearch& group : groups) open.push_back(&group);
    const double certify_below = problem.options.certify_below;
    for (std::int64_t budget = kFirstBudget; !open.empty() && work > 0; budget *= 2) {
        if (certify_below > 0 && known.max > certify_below) return;
        const auto share = std::max<std::int64_t>(1, work / static_cast<std::int64_t>(open.size()));
        std::vector<std::int64_t> before;
        for (const DistanceSearch* group : open) before.push_back(group->spent());
        parallel_chunks(open.size(), 1, problem.task,
                        [&](std::size_t i, std::size_t) { open[i]->run(known, std::min(budget, share)); });
        std::vector<DistanceSearch*> still_open;
        for (std::size_t i = 0; i < open.size(); ++i) {
            work -= open[i]->spent() - before[i];
            const DistanceBound found = open[i]->found();
            raise(known, found.max, found.worst);
            if (!open[i]->done()) still_open.push_back(open[i]);
        }
        open = std::move(still_open);
    }
}

}  // namespace

DistanceBound bound_distance(const TriangleMesh& from, const TriangleMesh& to, const Bvh& to_bvh,
                             const DistanceBound& known, const DistanceBoundOptions& options,
                             const Task& task) {
    const DistanceProblem problem{from, to, to_bvh, options, task, closest_to_vertices(from, to_bvh, task)};
    DistanceBound best = known;
    for (std::size_t v = 0; v < from.vertices.size(); ++v) {
        if (problem.at_vertices[v].face < 0) continue;
        raise(best, std::sqrt(problem.at_vertices[v].squared_distance), from.vertices[v]);
    }
    std::vector<DistanceSearch> groups;
    for (std::size_t begin = 0; begin < from.faces.size(); begin += kGroup) {
        groups.emplace_back(problem, begin, std::min(begin + kGroup, from.faces.size()));
    }
    if (options.refine) {
        const auto vertices = static_cast<std::int64_t>(from.vertices.size());
        search_in_rounds(groups, best, options.work - vertices, problem);
    }
    std::vector<double> bounds(groups.size());
    parallel_chunks(groups.size(), 1, task,
                    [&](std::size_t i, std::size_t) { bounds[i] = groups[i].bound(); });
    best.bound = best.max;
    for (const double bound : bounds) best.bound = std::max(best.bound, bound);
    return best;
}

}  // namespace pfgeom
