// Both directions, in parts that do not depend on the number of threads: octree cells after some levels, and
// groups of faces that lie together. What the parts find is merged in order.
#include "pfgeom/report/tree_bound.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/report/tree_bound_cells.h"
#include "pfgeom/report/tree_bound_pieces.h"

#include <algorithm>
#include <optional>

namespace pfgeom {
namespace {

constexpr std::size_t kParts = 1024;      // cells, about
constexpr std::size_t kBatch = 64;        // parts that are searched before they are merged
constexpr std::size_t kGroup = 256;       // faces
constexpr double kDistanceError = 1e-12;  // of computed distances; coordinates are about 1
constexpr const char* kStage = "certify";

// Breadth first, until there are enough.
std::vector<TreeBoundCell> open_cells(CellSearch& search) {
    std::vector<TreeBoundCell> open{search.root()};
    while (!open.empty() && open.size() < kParts && search.found().sides_defined) {
        std::vector<TreeBoundCell> children;
        for (TreeBoundCell& cell : open) search.split(cell, children);
        open = std::move(children);
    }
    return open;
}

// Every kBatch-th cell, so that a search that ends early has looked everywhere.
std::vector<std::size_t> strided(std::size_t n) {
    const std::size_t stride = (n + kBatch - 1) / kBatch;
    std::vector<std::size_t> order;
    for (std::size_t first = 0; first < stride; ++first)
        for (std::size_t i = first; i < n; i += stride) order.push_back(i);
    return order;
}

void search_cells(const TreeBoundProblem& problem, TreeBoundFindings& total) {
    CellSearch top(problem, problem.options.labels, 0, false);
    const std::vector<TreeBoundCell> open = open_cells(top);
    total.merge(top.found());
    const std::vector<std::size_t> order = strided(open.size());
    const std::int64_t share = problem.options.max_cells / static_cast<std::int64_t>(kBatch);
    for (std::size_t begin = 0; begin < order.size(); begin += kBatch) {
        if (!total.sides_defined) return;
        if (total.counts.cells > problem.options.max_cells ||
            total.counts.unresolved > problem.options.max_unresolved) {
            total.complete = false;
            return;
        }
        const std::size_t n = std::min(kBatch, order.size() - begin);
        const bool refuted = total.counts.wrong > 0;
        std::vector<std::optional<CellSearch>> searches(n);
        parallel_chunks(n, 1, problem.task, [&](std::size_t i, std::size_t) {
            const std::size_t cell = order[begin + i];
            searches[i].emplace(problem, problem.options.labels / kBatch + 1, cell + 1, refuted);
            searches[i]->run(open[cell], share);
        });
        for (const auto& search : searches) total.merge(search->found());
        problem.task.report(0.7 * static_cast<double>(begin + n) / static_cast<double>(order.size()), kStage);
    }
}

// Faces in the order of the octree cells (ten levels) of their first corners.
std::vector<std::int32_t> faces_in_space(const TriangleMesh& mesh, const Box& box) {
    const Vec3 extent = box.extent();
    const double scale = 1023 / std::max({extent.x, extent.y, extent.z});
    std::vector<std::pair<std::uint32_t, std::int32_t>> keys;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Vec3 p = (mesh.vertices[mesh.faces[f][0]] - box.lo) * scale;
        std::uint32_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto place = static_cast<std::uint32_t>(p[axis]);
            for (int bit = 0; bit < 10; ++bit) key |= (place >> bit & 1U) << (3 * bit + axis);
        }
        keys.emplace_back(key, static_cast<std::int32_t>(f));
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::int32_t> faces;
    for (const auto& [key, face] : keys) faces.push_back(face);
    return faces;
}

void search_pieces(const TreeBoundProblem& problem, TreeBoundFindings& total) {
    const std::vector<std::int32_t> faces =
        faces_in_space(problem.sides.mesh(), problem.sides.bvh().bounds());
    for (std::size_t begin = 0; begin < faces.size(); begin += kBatch * kGroup) {
        const auto batch = std::span(faces).subspan(begin, std::min(kBatch * kGroup, faces.size() - begin));
        std::vector<std::optional<PieceSearch>> searches((batch.size() + kGroup - 1) / kGroup);
        parallel_chunks(batch.size(), kGroup, problem.task, [&](std::size_t first, std::size_t last) {
            auto& search = searches[first / kGroup].emplace(problem, begin + first);
            search.run(batch.subspan(first, last - first));
        });
        for (const auto& search : searches) total.merge(search->found());
        const double done = static_cast<double>(begin + batch.size()) / static_cast<double>(faces.size());
        problem.task.report(0.7 + 0.3 * done, kStage);
    }
}

void check_input(const SetTree& tree, const TriangleMesh& mesh, double tolerance) {
    if (tree.nodes.empty()) throw InvalidInput("bound_tree: the tree has no nodes");
    if (mesh.faces.empty()) throw InvalidInput("bound_tree: the mesh has no faces");
    if (!(tolerance > 4 * kDistanceError)) throw InvalidInput("bound_tree: the tolerance is too small");
}

}  // namespace

TreeBound bound_tree(const SetTree& tree, const TriangleMesh& mesh, const Bvh& bvh, double tolerance,
                     const TreeBoundOptions& options, const Task& task) {
    check_input(tree, mesh, tolerance);
    const SurfaceSides sides(mesh, bvh, task);
    TreeBound bound;
    bound.proved = tolerance;
    bound.sides_defined = sides.defined();
    if (!bound.sides_defined) return bound;

    const TreePruner pruner(tree);
    const TreeBoundProblem problem{pruner, sides, tree.box(), tolerance - 2 * kDistanceError, options, task};
    TreeBoundFindings found(options, options.labels, 0);
    search_cells(problem, found);
    if (options.mesh_to_model && found.sides_defined) search_pieces(problem, found);

    bound.proved += found.excess;
    bound.sides_defined = found.sides_defined;
    bound.complete = found.complete;
    bound.counts = found.counts;
    bound.certified = found.sides_defined && found.complete && found.counts.wrong == 0 &&
                      found.counts.unresolved == 0 && found.counts.lost == 0;
    for (const auto& [leaf, points] : found.counter_examples) {
        const auto& list = points.points();
        bound.counter_examples.insert(bound.counter_examples.end(), list.begin(), list.end());
    }
    bound.labels = found.labels.points();
    bound.missed = std::move(found.missed);
    for (const std::int32_t leaf : found.suspects)
        if (!found.needed.contains(leaf)) bound.suspects.push_back(leaf);
    return bound;
}

}  // namespace pfgeom
