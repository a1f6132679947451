#include "pfgeom/render/ray_tree.h"

#include "brute_force.h"
#include "random_tree.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

const Frame kUnit{};

bool is_inside(const SetTree& tree, const Vec3& p) {
    return tree.box().contains(p) && contains(tree, p);
}

TEST(RayTree, AsBruteForceOnRandomTrees) {
    Random random(5);
    int hits = 0;
    for (int i = 0; i < 60; ++i) {
        const SetTree tree = test::random_tree(random, 6);
        const RayTree target(tree, kUnit, {});
        const auto found = test::compare(
            target, [&](const Vec3& p) { return is_inside(tree, p); }, tree.box(), 100U + i, 300, 300);
        EXPECT_EQ(found.missed, 0) << "tree " << i;
        EXPECT_EQ(found.untrue, 0) << "tree " << i;
        hits += found.hits;
    }
    EXPECT_GT(hits, 2000);
}

TreeQuadric question(const Quadric& q) {
    TreeQuadric question;
    question.quadric = q;
    return question;
}

// A block with a bore along z and half a ball on top.
SetTree bored_block() {
    SetTree tree = test::box_tree(10, 2048);
    tree.quadrics = {question({{-1, -1, 0, 0, 0, 0, 0.2, 0, 0, 0.0525}}),        // radius 1/4 around x = 0.1
                     question({{-1, -1, -1, 0, 0, 0, -0.6, 0.4, 0.8, -0.25}})};  // radius 0.2
    for (const double side : {-1.0, 1.0}) {
        tree.quadrics.push_back(question({{0, 0, 0, 0, 0, 0, side, 0, 0, 0.6}}));
        tree.quadrics.push_back(question({{0, 0, 0, 0, 0, 0, 0, side, 0, 0.5}}));
        tree.quadrics.push_back(question({{0, 0, 0, 0, 0, 0, 0, 0, side, 0.4}}));
    }
    tree.nodes = {test::ask(0, 1, 2), test::leaf(false)};
    for (std::int32_t k = 0; k < 6; ++k) tree.nodes.push_back(test::ask(2 + k, 3 + k, 24 - 3 * k));
    tree.nodes.push_back(test::leaf(true));
    for (std::int32_t at = 9; at < 27; at += 3) {
        tree.nodes.push_back(test::ask(1, at + 1, at + 2));
        tree.nodes.push_back(test::leaf(true));
        tree.nodes.push_back(test::leaf(false));
    }
    return tree;
}

TEST(RayTree, AsBruteForceOnAPart) {
    const SetTree tree = bored_block();
    const RayTree target(tree, kUnit, {});
    const auto found = test::compare(
        target, [&](const Vec3& p) { return is_inside(tree, p); }, {{-0.7, -0.6, -0.5}, {0.7, 0.6, 0.6}}, 1,
        20000, 200);
    EXPECT_EQ(found.missed, 0);
    EXPECT_EQ(found.untrue, 0);
    EXPECT_GT(found.hits, 8000);
}

// Every ray from within ends at a wall, also those along edges of cells.
TEST(RayTree, NoPinHoles) {
    const SetTree tree = bored_block();
    const RayTree target(tree, kUnit, {});
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 from{i % 2 == 0 ? -0.5 : -0.41, i % 3 == 0 ? -0.25 : 0.3, i % 5 == 0 ? 0 : -0.125};
        const Ray ray = test::random_ray(random, {{-1, -1, -1}, {1, 1, 1}});
        EXPECT_TRUE(target.first_hit({from, ray.direction}, {}).found()) << i;
    }
}

TEST(RayTree, KnownHits) {
    const SetTree tree = bored_block();
    const RayTree target(tree, kUnit, {});
    const SurfaceHit side = target.first_hit({{-3, 0.1, 0.2}, {1, 0, 0}}, {});
    EXPECT_NEAR(side.t, 2.4, 1e-12);
    EXPECT_NEAR(side.normal.x, -1, 1e-12);
    EXPECT_GE(side.function, 0);
    // Down the bore, and out of it sideways.
    EXPECT_FALSE(target.first_hit({{0.1, 0, 3}, {0, 0, -1}}, {}).found());
    const SurfaceHit wall = target.first_hit({{0.1, 0, 0}, {0, 2, 0}}, {});
    EXPECT_NEAR(wall.t, 0.125, 1e-12);
    EXPECT_NEAR(wall.normal.y, -1, 1e-12);
    // The span counts: the far side of the block.
    EXPECT_NEAR(target.first_hit({{-3, 0.4, 0.2}, {1, 0, 0}}, {2.5, 9}).t, 3.6, 1e-12);
    EXPECT_FALSE(target.first_hit({{-3, 0.1, 0.2}, {1, 0, 0}}, {0, 2.3}).found());
}

// The sides of a tree's box are surface, too; they have no quadric.
TEST(RayTree, BoxIsSurface) {
    SetTree tree = test::box_tree(10, 1024);
    tree.nodes = {test::leaf(true)};
    derive(tree);
    const RayTree target(tree, kUnit, {});
    const SurfaceHit in = target.first_hit({{-2, 0.3, 0.2}, {1, 0, 0}}, {});
    EXPECT_DOUBLE_EQ(in.t, 1.5);
    EXPECT_EQ(in.normal, (Vec3{-1, 0, 0}));
    EXPECT_EQ(in.function, -1);
    const SurfaceHit out = target.first_hit({{0, 0.3, 0.2}, {0, 0, -1}}, {});
    EXPECT_DOUBLE_EQ(out.t, 0.7);
    EXPECT_EQ(out.normal, (Vec3{0, 0, -1}));
}

}  // namespace
}  // namespace pfgeom
