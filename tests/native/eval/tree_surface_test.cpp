#include "pfgeom/eval/tree_surface.h"

#include "random_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfgeom {
namespace {

using Kind = TreeNode::Kind;

// In units of 2^-10: x < 1/2, and within a ball of radius 1/4 about the origin if x < -3/8; the box has half
// edge 3/4.
SetTree half_box() {
    SetTree tree = test::box_tree(10, 1536);
    tree.quadrics = {test::of_family(0, {-1, 512}), test::of_family(0, {1, 384}),
                     test::of_family(7, {-1024, 0, 0, 0, 64})};
    tree.nodes = {test::ask(0, 1, 6), test::ask(1, 2, 3), test::leaf(true), test::ask(2, 4, 5),
                  test::leaf(true),   test::leaf(false),  test::leaf(false)};
    derive(tree);
    return tree;
}

TEST(TreeSurface, AreasOfABoxWithACutCorner) {
    const TreeSurface surface = find_surface(half_box());
    const double side = 1.5 * 1.5;
    EXPECT_NEAR(surface.patches[0].area, side, 1e-9);
    EXPECT_NEAR(surface.patches[1].area, side, 1e-9);  // the ball does not reach beyond x = -1/4
    EXPECT_EQ(surface.patches[2].area, 0);
    EXPECT_TRUE(surface.patches[2].points.empty());
    EXPECT_NEAR(surface.patches[0].area_above, side, 1e-9);
    EXPECT_EQ(surface.box_area[0], 0);
    EXPECT_EQ(surface.box_area[1], 0);
    for (std::size_t i = 2; i < 6; ++i) EXPECT_NEAR(surface.box_area[i], 1.5 * 0.875, 0.02);
    EXPECT_EQ(surface.cut_area, 0);
}

TEST(TreeSurface, AreaOfABallAndItsHole) {
    SetTree tree = test::box_tree(10, 1536);
    tree.quadrics = {test::of_family(7, {-1024, 0, 0, 0, 256}), test::of_family(7, {1024, 0, 0, 0, -64})};
    tree.nodes = {test::ask(0, 1, 4), test::ask(1, 2, 3), test::leaf(true), test::leaf(false),
                  test::leaf(false)};
    derive(tree);
    const TreeSurface surface = find_surface(tree);
    EXPECT_NEAR(surface.patches[0].area, std::numbers::pi, 0.05);
    EXPECT_NEAR(surface.patches[1].area, std::numbers::pi / 4, 0.04);
    EXPECT_EQ(surface.patches[1].area, surface.patches[1].area_above);
    std::ranges::swap(tree.nodes[2].kind, tree.nodes[3].kind);  // the small ball itself
    const TreeSurface ball = find_surface(tree);
    EXPECT_TRUE(ball.patches[0].points.empty());
    EXPECT_NEAR(ball.patches[1].area, std::numbers::pi / 4, 0.04);
    EXPECT_EQ(ball.patches[1].area_above, 0);
}

TEST(TreeSurface, CutsAreSurfacesOfTheirOwn) {
    SetTree tree = test::box_tree(10, 1024);
    TreeNode cut;
    cut.kind = Kind::cut;
    cut.axis = 1;
    cut.position = 8;
    tree.nodes = {test::with_children(cut, 1, 2), test::leaf(false), test::leaf(true)};
    derive(tree);
    const TreeSurface surface = find_surface(tree);
    EXPECT_NEAR(surface.cut_area, 1, 1e-9);
    EXPECT_NEAR(surface.box_area[2], 1, 1e-9);
    EXPECT_EQ(surface.box_area[3], 0);
}

TEST(TreeSurface, ASmallPatchIsFoundAndFilled) {
    // A ball of radius 1/128, which few rays meet.
    SetTree tree = test::box_tree(14, 1 << 15);
    tree.quadrics = {test::of_family(7, {-(1 << 14), 0, 0, 0, 1})};
    tree.nodes = {test::ask(0, 1, 2), test::leaf(true), test::leaf(false)};
    derive(tree);
    const TreeSurface surface = find_surface(tree);
    ASSERT_GE(surface.patches[0].points.size(), 100U);
    const double radius = 1.0 / 128;
    for (const Vec3& p : surface.patches[0].points) EXPECT_NEAR(norm(p), radius, 1e-12);
}

TEST(TreeSurface, PointsLieWhereSidesChange) {
    Random random(11);
    std::size_t seen = 0;
    for (int round = 0; round < 60; ++round) {
        const SetTree tree = test::random_tree(random, 6);
        const TreeSurface surface = find_surface(tree, {}, 16);
        ASSERT_EQ(surface.patches.size(), tree.quadrics.size());
        for (std::size_t q = 0; q < tree.quadrics.size(); ++q) {
            const QuadricPatch& patch = surface.patches[q];
            std::size_t changes = 0;
            for (const Vec3& p : patch.points) {
                const Quadric& quadric = tree.quadrics[q].quadric;
                const Vec3 n = normalized(quadric.gradient(p));
                const double slack = 1e-9 * norm(quadric.gradient(p)) + 1e-12;
                EXPECT_LE(std::abs(quadric.value(p)), slack);
                const double step = 1e-7;
                changes += contains(tree, p + step * n) != contains(tree, p - step * n) ? 1U : 0U;
            }
            // At an edge, or where the quadric bends away, the step may end on another side.
            EXPECT_GE(static_cast<double>(changes), 0.98 * static_cast<double>(patch.points.size()));
            seen += patch.points.size();
        }
    }
    EXPECT_GT(seen, 10000U);
}

TEST(TreeSurface, PointsOnAQuadric) {
    const Quadric cone{{1, 1, -1}};
    const std::vector<Vec3> points = points_on(cone, {{-1, -1, -1}, {1, 1, 1}});
    EXPECT_GT(points.size(), 300U);
    for (const Vec3& p : points) {
        EXPECT_NEAR(cone.value(p), 0, 1e-14);
        EXPECT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1);
    }
    EXPECT_TRUE(points_on({{1, 1, 1, 0, 0, 0, 0, 0, 0, 1}}, {{-1, -1, -1}, {1, 1, 1}}).empty());
}

TEST(TreeSurface, CanBeStopped) {
    CancelToken token;
    token.cancel();
    EXPECT_THROW(find_surface(half_box(), Task{1, &token, {}}), Cancelled);
}

}  // namespace
}  // namespace pfgeom
