#include "pfgeom/base/random.h"
#include "pfgeom/fit/set_tree.h"
#include "pfgeom/function/check.h"
#include "pfgeom/function/quadric_family.h"
#include "pfgeom/mesh/signed_distance.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

// Samples that the tree gets wrong.
std::size_t wrong_of(const TreeFit& fit) {
    return wrong_samples(fit.raw, fit.samples);
}

TreeFitOptions within(double tolerance, int effort = 1) {
    TreeFitOptions options;
    options.tolerance = tolerance;
    options.effort = effort;
    return options;
}

// Random points outside the tolerance whose side the tree gets wrong.
std::vector<KnownSide> contradictions(const SetTree& tree, const TriangleMesh& mesh, double tolerance) {
    const Bvh bvh(mesh);
    const SignedDistance distance(mesh, bvh);
    Random random(77);
    std::vector<KnownSide> wrong;
    for (int i = 0; i < 20000; ++i) {
        const auto coordinate = [&] { return 2 * random.uniform() - 1; };
        const Vec3 p{coordinate(), coordinate(), coordinate()};
        const double d = distance(p).distance;
        if (std::abs(d) > tolerance && contains(tree, p) != (d > 0)) wrong.push_back({p, d > 0});
    }
    return wrong;
}

TreeFit fitted(const TriangleMesh& mesh, TreeFitOptions options) {
    const auto exact = find_exact_patches(mesh);
    options.exact = exact;
    const TreeFit fit = fit_set_tree(mesh, Bvh(mesh), options);
    EXPECT_EQ(wrong_of(fit), 0U);
    EXPECT_EQ(find_flaw(fit.tree), "");
    SetTree again = fit.tree;
    derive(again);
    EXPECT_EQ(again, fit.tree) << "what is derived follows from the integers";
    return fit;
}

TEST(SetTreeFit, ABoxOnItsFrameIsItsBox) {
    const TriangleMesh mesh = shapes::cube(0.75);
    const TreeFit fit = fitted(mesh, within(0.002));
    EXPECT_EQ(fit.tree.nodes.size(), 1U);
    EXPECT_TRUE(contains(fit.tree, {0.7, 0.7, 0.7}));
    EXPECT_FALSE(contains(fit.tree, {0.8, 0, 0}));
}

TEST(SetTreeFit, AnEllipsoidIsOneQuestion) {
    const TriangleMesh mesh = shapes::ellipsoid({0.9, 0.5, 0.3}, 5);
    const TreeFit fit = fitted(mesh, within(0.004));
    EXPECT_EQ(fit.tree.quadrics.size(), 1U);
    EXPECT_EQ(fit.tree.nodes.size(), 3U);
    EXPECT_TRUE(contradictions(fit.tree, mesh, 0.004).empty());
}

TEST(SetTreeFit, ACylinderTakesItsMantleAlone) {
    const TriangleMesh mesh = shapes::scaled(shapes::cylinder(128), {0.7, 0.7, 0.7});
    const TreeFit fit = fitted(mesh, within(0.003));
    EXPECT_EQ(fit.tree.quadrics.size(), 1U) << "the lids lie on the box";
    EXPECT_TRUE(contradictions(fit.tree, mesh, 0.003).empty());
}

TEST(SetTreeFit, TwoCubesShareTheirPlanes) {
    const TriangleMesh mesh = shapes::joined(shapes::cube(0.2, {-0.5, 0, 0}), shapes::cube(0.2, {0.5, 0, 0}));
    const TreeFit fit = fitted(mesh, within(0.002));
    EXPECT_LE(fit.tree.nodes.size(), 5U);
    EXPECT_TRUE(contradictions(fit.tree, mesh, 0.002).empty());
}

TEST(SetTreeFit, HasCavities) {
    const TriangleMesh mesh =
        shapes::joined(shapes::sphere(5, 0.8), shapes::flipped(shapes::sphere(4, 0.4, {0.1, 0, 0})));
    const TreeFit fit = fitted(mesh, within(0.004));
    EXPECT_EQ(fit.tree.quadrics.size(), 2U);
    EXPECT_FALSE(contains(fit.tree, {0.1, 0, 0}));
    EXPECT_TRUE(contains(fit.tree, {0, 0, 0.6}));
    EXPECT_TRUE(contradictions(fit.tree, mesh, 0.004).empty());
}

TEST(SetTreeFit, IsTheSameOnAnyNumberOfThreads) {
    const TriangleMesh mesh = shapes::torus(0.6, 0.25, 48, 24);
    const Bvh bvh(mesh);
    const TreeFit one = fit_set_tree(mesh, bvh, within(0.01, 0), {1, nullptr, {}});
    const TreeFit three = fit_set_tree(mesh, bvh, within(0.01, 0), {3, nullptr, {}});
    EXPECT_EQ(one.tree, three.tree);
    EXPECT_EQ(wrong_of(one), 0U);
}

TEST(SetTreeFit, RepairTakesCounterExamples) {
    const TriangleMesh mesh = shapes::torus(0.6, 0.25, 48, 24);
    const Bvh bvh(mesh);
    TreeFit fit = fit_set_tree(mesh, bvh, within(0.01, 0));
    std::vector<KnownSide> wrong = contradictions(fit.tree, mesh, 0.01);
    // A claim that is not true of the torus either must be obeyed: a hole at the thickest place.
    wrong.push_back({{0.6, 0, 0}, false});
    repair_set_tree(fit, bvh, wrong);
    EXPECT_EQ(wrong_of(fit), 0U);
    for (const KnownSide& known : wrong) EXPECT_EQ(contains(fit.tree, known.point), known.inside);
}

TEST(SetTreeFit, LeavesWhatHasTooManyRegionsToOthers) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    TreeFitOptions options = within(0.005, 0);
    options.most_regions = 3;
    EXPECT_TRUE(fit_set_tree(mesh, Bvh(mesh), options).tree.nodes.empty());
}

TEST(SetTreeFit, LeavesWhatTakesTooManyBitsToOthers) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    TreeFitOptions options = within(0.005, 0);
    options.most_bits = 100;
    const TreeFit fit = fit_set_tree(mesh, Bvh(mesh), options);
    EXPECT_FALSE(fit.regions.empty());
    EXPECT_TRUE(fit.tree.nodes.empty());
    EXPECT_GE(fit.bits, options.most_bits);
}

TEST(SetTreeFit, CanBeCancelled) {
    const TriangleMesh mesh = shapes::sphere(3, 0.8);
    CancelToken token;
    token.cancel();
    EXPECT_THROW(fit_set_tree(mesh, Bvh(mesh), within(0.01), {1, &token, {}}), Cancelled);
}

TEST(SetTreeFit, ReportsItsStages) {
    const TriangleMesh mesh = shapes::sphere(3, 0.8);
    double last = -1;
    Task task;
    task.progress = [&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    fit_set_tree(mesh, Bvh(mesh), within(0.02), task);
    EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace pfgeom
