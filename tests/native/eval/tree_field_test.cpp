#include "pfgeom/eval/tree_field.h"

#include "pfgeom/function/set_tree.h"
#include "random_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

using Kind = TreeNode::Kind;

Vec3 random_point(Random& random, double reach) {
    const auto coordinate = [&] { return reach * (2 * random.uniform() - 1); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
}

TreeQuadric axis_plane(std::uint8_t axis, std::int32_t sign, std::int32_t constant) {
    TreeQuadric q;
    q.family = axis;
    q.n = {sign, constant};
    return q;
}

// x < 1/2 and y < 1/4, in a box of half edge 3/4.
SetTree wedge() {
    SetTree tree = test::box_tree(10, 1536);
    tree.quadrics = {axis_plane(0, -1, 512), axis_plane(1, -1, 256)};
    tree.nodes = {test::ask(0, 1, 4), test::ask(1, 2, 3), test::leaf(true), test::leaf(false),
                  test::leaf(false)};
    derive(tree);
    return tree;
}

TEST(TreeField, DistanceToTheSidesOfAWedge) {
    const TreeField field(wedge());
    EXPECT_DOUBLE_EQ(field.value({0, 0, 0}), 0.25);
    EXPECT_DOUBLE_EQ(field.value({0.4, 0, 0}), 0.5 - 0.4);
    EXPECT_DOUBLE_EQ(field.value({0.6, 0, 0}), 0.5 - 0.6);
    EXPECT_DOUBLE_EQ(field.value({0, 0, 0.7}), 0.75 - 0.7);
    EXPECT_DOUBLE_EQ(field.value({0, 0, 0.9}), 0.75 - 0.9);
    Vec3 gradient;
    field.value_and_gradient({0.45, 0, 0}, gradient);
    EXPECT_EQ(gradient, (Vec3{-1, 0, 0}));
    field.value_and_gradient({0.2, 0.3, 0}, gradient);
    EXPECT_EQ(gradient, (Vec3{0, -1, 0}));
}

// A question whose two answers are the same must not show.
TEST(TreeField, NoZeroBetweenTwoInsides) {
    SetTree tree = test::box_tree(10, 1536);
    TreeNode cut;
    cut.kind = Kind::cut;
    cut.position = 16;  // x = 0
    tree.nodes = {test::with_children(cut, 1, 2), test::leaf(true), test::leaf(true)};
    derive(tree);
    EXPECT_DOUBLE_EQ(TreeField(tree).value({0, 0, 0}), 0.75);
    const Box middle{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}};
    EXPECT_GT(TreeField(tree).range(middle).lo, 0.5);
}

TEST(TreeField, SignIsThatOfContains) {
    int inside = 0, points = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const SetTree tree = test::random_tree(random, 5);
        const TreeField field(tree);
        for (int i = 0; i < 200; ++i) {
            Vec3 p = random_point(random, 1.1);
            // Half of them on a cut or a side of the box, exactly.
            const TreeNode& node = tree.nodes[random.below(tree.nodes.size())];
            if (i % 2 == 0) p[node.axis] = node.kind == Kind::cut ? node.cut : tree.box().hi[node.axis];
            EXPECT_EQ(field.value(p) >= 0, contains(tree, p)) << seed;
            inside += contains(tree, p) ? 1 : 0;
            ++points;
        }
    }
    EXPECT_GT(inside, points / 20);
    EXPECT_LT(inside, points * 19 / 20);
}

// The window of the search must not change the value: the three-term form, without it.
double plain(const SetTree& tree, std::int32_t index, const Vec3& p) {
    const TreeNode& node = tree.nodes[static_cast<std::size_t>(index)];
    if (node.leaf()) return node.kind == Kind::inside ? 1e30 : -1e30;
    const double high = plain(tree, node.high, p), low = plain(tree, node.low, p);
    double s = p[node.axis] - node.cut;
    if (node.kind == Kind::ask) {
        const Quadric& q = tree.quadrics[static_cast<std::size_t>(node.quadric)].quadric;
        s = q.value(p) / std::max(norm(q.gradient(p)), 0.25);
    }
    return std::max({std::min(s, high), std::min(-s, low), std::min(high, low)});
}

TEST(TreeField, ValueIsTheThreeTermForm) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const SetTree tree = test::random_tree(random, 5);
        const TreeField field(tree);
        const Box box = tree.box();
        for (int i = 0; i < 100; ++i) {
            const Vec3 p = random_point(random, 1);
            double sides = 1e300;
            for (int axis = 0; axis < 3; ++axis)
                sides = std::min({sides, p[axis] - box.lo[axis], box.hi[axis] - p[axis]});
            EXPECT_EQ(field.value(p), std::min(sides, plain(tree, 0, p))) << seed;
            Vec3 gradient;
            EXPECT_EQ(field.value_and_gradient(p, gradient), field.value(p));
        }
    }
}

TEST(TreeField, RangesContainTheValues) {
    int decided = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const TreeField field(test::random_tree(random, 5));
        for (int i = 0; i < 40; ++i) {
            const Vec3 corner = random_point(random, 1);
            const double edge = std::ldexp(1.0, -static_cast<int>(random.below(8)));
            const Box box{corner, corner + Vec3{edge, edge, edge}};
            const Interval range = field.range(box);
            decided += range.lo >= 0 || range.hi < 0 ? 1 : 0;
            for (int k = 0; k < 30; ++k) {
                const Vec3 p = corner + edge * Vec3{random.uniform(), random.uniform(), random.uniform()};
                const double value = field.value(p);
                EXPECT_GE(value, range.lo) << seed;
                EXPECT_LE(value, range.hi) << seed;
            }
        }
    }
    EXPECT_GT(decided, 60 * 40 / 3);
}

}  // namespace
}  // namespace pfgeom
