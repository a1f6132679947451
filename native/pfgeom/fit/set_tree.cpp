#include "pfgeom/fit/set_tree.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/fit/shared_integers.h"
#include "pfgeom/fit/tree_checks.h"
#include "pfgeom/fit/tree_patches.h"
#include "pfgeom/fit/tree_seams.h"
#include "pfgeom/function/quadric_family.h"
#include "pfgeom/segment/segment.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace pfgeom {
namespace {

// What the levels of effort differ in.
struct Effort {
    std::size_t samples;  // of the innermost shell, for each quadric
    std::size_t most_samples;
    int scales;               // of a quadric
    std::size_t orders;       // in which quadrics are made to share integers
    std::vector<int> powers;  // settings that are scouted
    std::vector<double> single_weights;
    std::vector<int> peeled_powers;
    std::size_t finalists;  // of them
    int tried;              // questions of a cell, by the finalists
};

Effort effort_of(int level) {
    if (level <= 0) return {1000, 100000, 16, 4, {2, 4}, {0.4}, {4}, 1, 1};
    if (level == 1) return {3000, 300000, 40, 16, {1, 2, 3, 4, 6}, {0.1, 0.2, 0.5, 0.9}, {2, 4}, 4, 6};
    return {6000,         800000, 80, 64, {1, 2, 3, 4, 5, 6, 8}, {0.1, 0.2, 0.35, 0.5, 0.7, 0.9},
            {1, 2, 4, 6}, 8,      10};
}

// The more seams, the more there is to see; too few are dear, since what they miss is mended leaf by leaf
// (printed part of 55 quadrics: 40,000 samples end at 1355 bytes, 150,000 at 1264, 400,000 at 1130).
// Of whole quadrics the hidden part is checked already.
std::size_t sample_count(const Effort& effort, const TreeFit& fit) {
    constexpr std::size_t kLeast = 20000;
    if (fit.mostly_whole()) return kLeast;
    return std::clamp(effort.samples * fit.quadrics.size(), kLeast, effort.most_samples);
}

// SegmentOptions::most_misalignment that a cone does not break: a funnel of 7 quadrics is 7 regions instead
// of 25.
constexpr double kConesWhole = 0.16;

// Half the tolerance or a little less is the unit of constants.
int resolution_for(double tolerance) {
    int resolution = 0;
    while (resolution < kMostResolution && std::ldexp(1.0, -resolution) > tolerance / 2) ++resolution;
    return resolution;
}

// To the nearest unit: a flat side of the object on the box takes no question.
void set_box(SetTree& tree, const Box& bounds) {
    const double unit = std::ldexp(1.0, -(tree.resolution + 1));
    for (std::size_t d = 0; d < 3; ++d) {
        const int axis = static_cast<int>(d);
        tree.low[d] = static_cast<std::int32_t>(std::floor(bounds.lo[axis] / unit + 0.5));
        tree.high[d] =
            std::max(tree.low[d] + 1, static_cast<std::int32_t>(std::floor(bounds.hi[axis] / unit + 0.5)));
    }
}

std::vector<Region> find_regions(const TriangleMesh& mesh, const Bvh& bvh, const TreeFitOptions& options,
                                 const Task& task) {
    const SignedDistance distance(mesh, bvh);
    SegmentOptions segmenting;
    segmenting.tolerance = options.tolerance * options.fit_share;
    segmenting.most_regions = options.most_regions;
    const std::vector<WholeQuadric> whole = find_whole_quadrics(
        mesh, distance, options.exact, segmenting.tolerance, options.tolerance * options.tube_share, task);
    segmenting.whole = whole;
    segmenting.exact = options.exact;
    segmenting.outermost_first = options.askew;
    if (options.askew) segmenting.most_misalignment = kConesWhole;
    return segment(mesh, segmenting, task);
}

double share_of_whole(const std::vector<Region>& regions) {
    double whole = 0, area = 0;
    for (const Region& region : regions) {
        whole += region.whole ? region.area : 0;
        area += region.area;
    }
    return whole / area;
}

// The quadric of each region, the same for regions that one serves.
void quantise_regions(const TriangleMesh& mesh, const std::vector<Region>& regions,
                      const TreeFitOptions& options, TreeFit& fit, const Task& task) {
    const int resolution = fit.tree.resolution, scales = effort_of(options.effort).scales;
    std::vector<RegionChecks> checks =
        region_checks(mesh, regions, options.held, options.tolerance, options.quantise_share, task);
    std::vector<QuantisedQuadric> own(regions.size());
    parallel_chunks(regions.size(), 1, task, [&](std::size_t r, std::size_t) {
        std::optional<QuantisedQuadric> best = quantise(checks[r].sums, checks[r].points, resolution, scales,
                                                        options.tolerance * options.tolerance);
        if (!best) {
            const TreeQuadric fine = round_finely(regions[r].quadric, resolution);
            best = {fine, estimated_bits(fine)};
        }
        own[r] = *best;
    });
    // What stands askew is hard to certify and wants the room that sharing takes (1706459: 1,122 bytes, and
    // no end with it).
    if (!options.askew)
        share_integers(checks, resolution, options.tolerance * options.tolerance,
                       effort_of(options.effort).orders, own, task);
    Patches patches = assign_patches(mesh, regions, own, options.tolerance * options.quantise_share);
    fit.quadrics = std::move(patches.quadrics);
    fit.patches = std::move(patches.of_face);
    if (!options.askew) return;
    for (QuantisedQuadric& q :
         find_separators(mesh, fit.quadrics, fit.patches, resolution, scales, options.tolerance, task))
        fit.quadrics.push_back(std::move(q));
}

// The tree as it is written: quadrics in the order of their first use, unused ones dropped.
void write_tree(TreeFit& fit) {
    SetTree& tree = fit.tree;
    tree.quadrics.clear();
    tree.nodes = fit.raw.nodes;
    std::vector<std::int32_t> number(fit.quadrics.size(), -1);
    for (TreeNode& node : tree.nodes) {
        if (node.kind != TreeNode::Kind::ask) continue;
        std::int32_t& n = number[static_cast<std::size_t>(node.quadric)];
        if (n < 0) {
            n = static_cast<std::int32_t>(tree.quadrics.size());
            tree.quadrics.push_back(fit.quadrics[static_cast<std::size_t>(node.quadric)].quadric);
        }
        node.quadric = n;
    }
    fit.bits = fit.raw.bits;
}

// Bits, and a penalty for what is wrong.
double price(const RawTree& tree) {
    return tree.bits + 1000.0 * tree.forced;
}

std::vector<RawTree> build_all(const TreeFit& fit, const std::vector<BuildOptions>& settings,
                               const Task& task) {
    std::vector<RawTree> trees(settings.size());
    parallel_chunks(settings.size(), 1, task, [&](std::size_t i, std::size_t) {
        trees[i] = build_tree(fit.samples, fit.quadrics, fit.tree.box(), settings[i], quiet(task, 1));
    });
    return trees;
}

// Each setting is the best of some mesh. A share of the samples tells which ones are worth a longer look at
// all.
std::vector<BuildOptions> scout(const TreeFit& fit, const Effort& effort, double most_bits,
                                const Task& task) {
    constexpr std::size_t kScouted = 4;  // one in so many samples, which have no order
    constexpr double kScoutedBits = 2;   // of fewer samples, but with less of a look ahead
    std::vector<BuildOptions> settings;
    for (const int power : effort.powers) {
        if (fit.mostly_whole()) break;
        for (const double weight : effort.single_weights) settings.push_back({power, weight});
    }
    for (const int power : effort.peeled_powers) settings.push_back({.power = power, .peel = true});
    for (BuildOptions& setting : settings) {
        setting.most_samples = fit.samples.size() / kScouted;
        setting.most_bits = kScoutedBits * most_bits;
    }
    const std::vector<RawTree> trees = build_all(fit, settings, task);
    std::vector<std::size_t> order(settings.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return price(trees[i]); });
    std::vector<BuildOptions> finalists;
    for (std::size_t k = 0; k < std::min(effort.finalists, order.size()); ++k) {
        if (trees[order[k]].nodes.empty()) break;
        finalists.push_back(settings[order[k]]);
        finalists.back().tried = effort.tried;
        finalists.back().most_samples = BuildOptions{}.most_samples;
        finalists.back().most_bits = most_bits;
    }
    return finalists;
}

void build(TreeFit& fit, const TreeFitOptions& options, const Task& task) {
    fit.raw = {{}, std::numeric_limits<double>::infinity(), 0};
    const std::vector<BuildOptions> finalists =
        scout(fit, effort_of(options.effort), options.most_bits, task);
    std::vector<RawTree> trees = build_all(fit, finalists, task);
    if (trees.empty()) return write_tree(fit);
    const auto best = static_cast<std::size_t>(std::ranges::min_element(trees, {}, price) - trees.begin());
    fit.build = finalists[best];
    fit.raw = std::move(trees[best]);
    write_tree(fit);
}

}  // namespace

TreeFit fit_set_tree(const TriangleMesh& mesh, const Bvh& bvh, const TreeFitOptions& options,
                     const Task& task) {
    TreeFit fit;
    fit.tree.resolution = static_cast<std::uint8_t>(resolution_for(options.tolerance));
    set_box(fit.tree, bvh.bounds());
    task.report(0, "finding regions");
    fit.regions = find_regions(mesh, bvh, options, quiet(task, task.threads));
    if (fit.regions.empty()) return fit;
    fit.whole = share_of_whole(fit.regions);
    refit_set_tree(fit, mesh, bvh, options, part_of(task, 0.2, 1));
    return fit;
}

void refit_set_tree(TreeFit& fit, const TriangleMesh& mesh, const Bvh& bvh, const TreeFitOptions& options,
                    const Task& task) {
    task.report(0, "rounding quadrics");
    quantise_regions(mesh, fit.regions, options, fit, quiet(task, task.threads));
    task.report(0.4, "sampling sides");
    const SignedDistance distance(mesh, bvh);
    const SampleOptions sampling{options.tolerance * options.tube_share,
                                 sample_count(effort_of(options.effort), fit), options.seed};
    const Task stage = quiet(task, task.threads);
    fit.samples = SampleTable(sample_sides(mesh, distance, fit.tree.box(), fit.patches, sampling, stage),
                              fit.quadrics, stage);
    task.report(0.5, "building the tree");
    build(fit, options, quiet(task, task.threads));
    task.report(1, "building the tree");
}

void repair_set_tree(TreeFit& fit, const Bvh& bvh, std::span<const KnownSide> points, const Task& task) {
    const Box box = fit.tree.box();
    std::vector<TreeSample> more;
    for (const KnownSide& known : points) {
        if (!box.contains(known.point)) continue;
        more.push_back({known.point, fit.patches[bvh.closest(known.point).face], known.inside});
    }
    fit.samples.add(more, fit.quadrics, task);
    fit.raw = repair_tree(fit.raw, fit.samples, fit.quadrics, box, fit.build, task);
    write_tree(fit);
}

}  // namespace pfgeom
