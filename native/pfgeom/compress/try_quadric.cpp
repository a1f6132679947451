#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/quadric.h"
#include "pfgeom/report/ellipsoid_bound.h"
#include "pfgeom/report/tree_bound.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Of the tolerance (of the largest error at the samples for metric rms), where the proof looks: what its
// cells leave open then stays below it.
constexpr double kProofShare = 0.985;
constexpr double kProofOfRms = 1.25;

// The tree that asks this one quadric.
SetTree tree_of(const Quadric& quadric) {
    SetTree tree;
    const std::int32_t wide = 5 << (tree.resolution - 1);  // the cube and a quarter
    tree.low = {-wide, -wide, -wide};
    tree.high = {wide, wide, wide};
    tree.quadrics.resize(1);
    tree.quadrics[0].quadric = quadric;
    tree.nodes.resize(3);
    tree.nodes[0] = {.kind = TreeNode::Kind::ask, .quadric = 0, .high = 1, .low = 2};
    tree.nodes[1].kind = TreeNode::Kind::inside;
    return tree;
}

// What is proved of the quadric's surface, in the cube's units; 0: nothing.
double proved_of(const Quadric& quadric, const TriangleMesh& mesh, const Bvh& bvh, double tolerance,
                 const Task& task) {
    const std::optional<double> quick = bound_ellipsoid(quadric, mesh, bvh);
    if (quick && *quick <= tolerance) return *quick;
    TreeBoundOptions options;
    options.labels = 0;
    const TreeBound bound = bound_tree(tree_of(quadric), mesh, bvh, tolerance, options, task);
    return bound.certified ? bound.proved : 0;
}

}  // namespace

std::optional<Outcome> try_quadric(const Goal& goal, const Task& task) {
    constexpr std::size_t kSamples = 4000;
    const FitTarget target(goal.mesh, kSamples);
    const double tolerance = goal.tolerance / target.frame.half();
    const std::optional<QuadricFit> fit = fit_quadric(target, rounding_step(tolerance));
    if (!fit || (goal.metric == Metric::max ? fit->max : fit->rms) > tolerance) return {};
    Outcome outcome;
    outcome.candidate = "quadric";
    outcome.functions.resize(1);
    outcome.functions[0].base = fit->quadric;
    outcome.object.frame = target.frame;
    outcome.object.shape = single_function(goal.inward);
    outcome.object.mesh_code =
        mesh_code_for(goal, (fit->max < 0.4 * tolerance ? 0.5 : 0.25) * goal.tolerance);
    prove(goal, outcome, task);
    if (!outcome.holds) return {};
    const double looked =
        goal.metric == Metric::max ? kProofShare * tolerance : std::max(tolerance, kProofOfRms * fit->max);
    outcome.bound_functions = proved_of(outcome.functions[0].base, in_cube(goal.mesh, target.frame),
                                        target.bvh, looked, quiet(task, task.threads)) *
                              target.frame.half();
    return outcome;
}

}  // namespace pfgeom
