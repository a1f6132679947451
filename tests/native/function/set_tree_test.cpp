#include "pfgeom/function/check.h"
#include "pfgeom/function/quadric_family.h"
#include "random_tree.h"

#include <gtest/gtest.h>

#include <functional>

namespace pfgeom {
namespace {

using Kind = TreeNode::Kind;

TEST(QuadricFamilies, EachTermBelongsToOneIntegerAndDegreesFall) {
    for (const QuadricFamily& family : quadric_families()) {
        unsigned seen = 0;
        for (int i = 0; i < family.size; ++i) {
            const unsigned terms = family.terms[static_cast<std::size_t>(i)];
            EXPECT_NE(terms, 0U) << family.name;
            EXPECT_EQ(seen & terms, 0U) << family.name;
            seen |= terms;
            if (i > 0) {
                EXPECT_LE(family.degree(i), family.degree(i - 1)) << family.name;
            }
        }
        EXPECT_EQ(family.degree(family.size - 1), 0) << family.name;
        EXPECT_EQ(family.has_squares(),
                  family.kind != FamilyKind::axis_plane && family.kind != FamilyKind::plane)
            << family.name;
    }
}

TEST(QuadricFamilies, IntegersAreScaledByDegree) {
    // 3/8 (x² + y²) + 5/16 x - 7/64, at a resolution of 6: linear 2^-(6-2), squares 2^-(6-2-1).
    TreeQuadric q;
    q.family = 4;
    q.linear_shift = 2;
    q.square_shift = 1;
    q.n = {3, 5, 0, -7};
    const Quadric expected{{3.0 / 8, 3.0 / 8, 0, 0, 0, 0, 5.0 / 16, 0, 0, -7.0 / 64}};
    EXPECT_EQ(expand(q, 6), expected);
}

TEST(QuadricFamilies, AxisPlanesHaveUnitSlope) {
    TreeQuadric q;
    q.family = 1;
    q.n = {-1, 12};
    const Quadric expected{{0, 0, 0, 0, 0, 0, 0, -1, 0, 12.0 / 1024}};
    EXPECT_EQ(expand(q, 10), expected);
}

TEST(SetTree, HalfACubeByACut) {
    SetTree tree = test::box_tree(10, 512);  // [-1/4, 1/4]³
    TreeNode cut;
    cut.kind = Kind::cut;
    cut.axis = 2;
    cut.position = 8;  // a quarter: z = -1/8
    tree.nodes = {test::with_children(cut, 1, 2), test::leaf(true), test::leaf(false)};
    derive(tree);
    EXPECT_EQ(find_flaw(tree), "");
    EXPECT_EQ(tree.nodes[0].cut, -0.125);
    EXPECT_TRUE(contains(tree, {0, 0, -0.125}));
    EXPECT_TRUE(contains(tree, {0.25, -0.25, 0.25}));
    EXPECT_FALSE(contains(tree, {0, 0, -0.126}));
    EXPECT_FALSE(contains(tree, {0.26, 0, 0}));
}

TEST(SetTree, CutsHalveTheCellThatIsLeft) {
    SetTree tree = test::box_tree(10, 2048);  // the cube
    TreeNode cut;
    cut.kind = Kind::cut;
    cut.position = 16;
    TreeNode fine = cut;
    fine.fine = true;
    fine.position = 1;
    tree.nodes = {test::with_children(cut, 1, 4), test::with_children(fine, 2, 3), test::leaf(false),
                  test::leaf(true), test::leaf(false)};
    derive(tree);
    EXPECT_EQ(find_flaw(tree), "");
    EXPECT_EQ(tree.nodes[0].cut, 0);
    EXPECT_EQ(tree.nodes[1].cut, 1.0 / 1024);
}

TEST(SetTree, RandomTreesAreWellFormed) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Random random(seed);
        EXPECT_EQ(find_flaw(test::random_tree(random, 4)), "") << seed;
    }
}

std::string flaw_after(const std::function<void(SetTree&)>& damage) {
    Random random(3);
    SetTree tree = test::random_tree(random, 5);
    damage(tree);
    return find_flaw(tree);
}

TEST(SetTree, FlawsAreNamed) {
    EXPECT_NE(flaw_after([](SetTree& t) { t.nodes.clear(); }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.nodes.pop_back(); }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.nodes.push_back(test::leaf(true)); }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.nodes[0].high = 0; }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.nodes[0].low = 1; }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.resolution = kMostResolution + 1; }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.high[1] = t.low[1]; }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.low[2] = -(1 << 20); }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.quadrics.push_back({}); }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.quadrics.at(0).family = kQuadricFamilies; }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.quadrics.at(0).n[0] = kMostQuadricInteger + 1; }), "");
    EXPECT_NE(flaw_after([](SetTree& t) { t.quadrics.at(0).linear_shift = kMostShift + 1; }), "");
}

TEST(SetTree, AQuadricMayBeAskedOnceOnAPath) {
    SetTree tree = test::box_tree(10, 512);
    tree.quadrics.resize(1);
    tree.quadrics[0].n = {1, 0};
    TreeNode ask;
    ask.kind = Kind::ask;
    ask.quadric = 0;
    TreeNode cut;
    cut.kind = Kind::cut;
    cut.position = 7;
    tree.nodes = {test::with_children(cut, 1, 4),
                  test::with_children(ask, 2, 3),
                  test::leaf(true),
                  test::leaf(false),
                  test::with_children(ask, 5, 6),
                  test::leaf(false),
                  test::leaf(true)};
    EXPECT_EQ(find_flaw(tree), "");  // on two paths
    tree.nodes = {test::with_children(ask, 1, 4), test::with_children(ask, 2, 3), test::leaf(true),
                  test::leaf(false), test::leaf(true)};
    EXPECT_NE(find_flaw(tree), "");
}

TEST(SetTree, DepthIsBounded) {
    const auto comb = [](int depth) {
        SetTree tree = test::box_tree(10, 512);
        TreeNode cut;
        cut.kind = Kind::cut;
        cut.position = 1;
        for (std::int32_t i = 0; i < depth; ++i) {
            tree.nodes.push_back(test::with_children(cut, 2 * i + 1, 2 * i + 2));
            tree.nodes.push_back(test::leaf(i % 2 == 0));
        }
        tree.nodes.push_back(test::leaf(true));
        return tree;
    };
    EXPECT_EQ(find_flaw(comb(kMaxTreeDepth)), "");
    EXPECT_NE(find_flaw(comb(kMaxTreeDepth + 1)), "");
}

}  // namespace
}  // namespace pfgeom
