#include "pfgeom/eval/pruned_tree.h"

#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

TreeNode leaf(bool inside) {
    TreeNode node;
    node.kind = inside ? TreeNode::Kind::inside : TreeNode::Kind::outside;
    return node;
}

double spread(Random& random) {
    return 2 * random.uniform() - 1;
}

Vec3 random_point(Random& random, const Box& box) {
    const Vec3 e = box.extent();
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    return box.lo + Vec3{x * e.x, y * e.y, z * e.z};
}

Box random_box(Random& random) {
    const Vec3 centre = random_point(random, {{-1, -1, -1}, {1, 1, 1}});
    const double size = 0.5 * random.uniform() * random.uniform();
    return {centre - Vec3{size, size / 2, size}, centre + Vec3{size, size / 2, size}};
}

// Questions about few quadrics, some of them nearly equal, and cuts; leaves of both labels.
struct RandomTree {
    explicit RandomTree(std::uint64_t seed) : random(seed) {
        tree.low = {-1800, -1700, -1900}, tree.high = {1900, 1800, 1700};
        for (int i = 0; i < 5; ++i) {
            TreeQuadric q;
            for (double& c : q.quadric.c) c = spread(random);
            tree.quadrics.push_back(q);
            for (double& c : q.quadric.c) c += 1e-3 * spread(random);
            tree.quadrics.push_back(q);
        }
        grow(7);
    }

    std::int32_t grow(int depth) {
        const auto index = static_cast<std::int32_t>(tree.nodes.size());
        if (depth == 0 || random.below(8) == 0) {
            tree.nodes.push_back(leaf(random.below(2) == 0));
            return index;
        }
        TreeNode node;
        node.kind = random.below(4) == 0 ? TreeNode::Kind::cut : TreeNode::Kind::ask;
        node.axis = static_cast<std::uint8_t>(random.below(3));
        node.cut = 0.8 * spread(random);
        if (node.kind == TreeNode::Kind::ask) {
            node.quadric = static_cast<std::int32_t>(random.below(tree.quadrics.size()));
        }
        tree.nodes.push_back(node);
        const std::int32_t high = grow(depth - 1), low = grow(depth - 1);
        tree.nodes[static_cast<std::size_t>(index)].high = high;
        tree.nodes[static_cast<std::size_t>(index)].low = low;
        return index;
    }

    Random random;
    SetTree tree;
};

TEST(PrunedTree, WholeTreeIsTheTree) {
    RandomTree r(1);
    const TreePruner pruner(r.tree);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random_point(r.random, {{-1, -1, -1}, {1, 1, 1}});
        EXPECT_EQ(pruner.contains(pruner.whole(), p), contains(r.tree, p));
    }
}

TEST(PrunedTree, TheFacesOfTheBoxBelongToIt) {
    SetTree tree;
    tree.low = {-1024, -1024, -1024}, tree.high = {1024, 1024, 1024};
    tree.nodes = {leaf(true)};
    const TreePruner pruner(tree);
    for (const double x : {-0.5, 0.5}) {
        EXPECT_TRUE(pruner.contains(pruner.whole(), {x, x, x}));
        EXPECT_FALSE(pruner.contains(pruner.whole(), {x * (1 + 1e-15), 0, 0}));
    }
}

TEST(PrunedTree, RightThroughoutItsBox) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        RandomTree r(seed);
        const TreePruner pruner(r.tree);
        PrunedTree part, smaller;
        for (int i = 0; i < 40; ++i) {
            Box box = random_box(r.random);
            pruner.prune(pruner.whole(), box, i % 2 == 0, {}, part);
            EXPECT_LE(part.size(), pruner.whole().size());
            for (int k = 0; k < 30; ++k) {
                const Vec3 p = random_point(r.random, box);
                ASSERT_EQ(pruner.contains(part, p), contains(r.tree, p)) << "seed " << seed;
            }
            box.hi = box.centre();
            pruner.prune(part, box, true, {}, smaller);
            EXPECT_LE(smaller.size(), part.size());
            for (int k = 0; k < 30; ++k) {
                const Vec3 p = random_point(r.random, box);
                ASSERT_EQ(pruner.contains(smaller, p), contains(r.tree, p)) << "seed " << seed;
            }
        }
    }
}

TEST(PrunedTree, RightWhereWhatIsKnownHolds) {
    for (std::uint64_t seed = 100; seed < 120; ++seed) {
        RandomTree r(seed);
        const TreePruner pruner(r.tree);
        PrunedTree part;
        for (int i = 0; i < 40; ++i) {
            const Box box = random_box(r.random);
            const Vec3 normal = normalized(Vec3{spread(r.random), spread(r.random), spread(r.random)});
            const KnownAnswer known = known_half_space(normal, dot(normal, random_point(r.random, box)));
            pruner.prune(pruner.whole(), box, i % 2 == 0, {&known, 1}, part);
            for (int k = 0; k < 40; ++k) {
                const Vec3 p = random_point(r.random, box);
                if (known.quadric.value(p) < 0) continue;
                ASSERT_EQ(pruner.contains(part, p), contains(r.tree, p)) << "seed " << seed;
            }
        }
    }
}

// x >= 0, and then z + x / 1000 < 0 although z >= 0: nowhere.
TEST(PrunedTree, AnswersOnThePathAnswerLaterQuestions) {
    SetTree tree;
    tree.low = {-2048, -2048, -2048}, tree.high = {2048, 2048, 2048};
    tree.quadrics.resize(2);
    tree.quadrics[0].quadric = {{0, 0, 0, 0, 0, 0, 0, 0, 1, 0}};
    tree.quadrics[1].quadric = {{0, 0, 0, 0, 0, 0, 1e-3, 0, 1, 1e-5}};
    tree.nodes = {{.kind = TreeNode::Kind::ask, .quadric = 0, .high = 1, .low = 4},
                  {.kind = TreeNode::Kind::ask, .quadric = 1, .high = 2, .low = 3},
                  leaf(false),
                  leaf(true),
                  leaf(false)};
    const TreePruner pruner(tree);
    const Box box{{0, -0.01, -0.01}, {0.02, 0.01, 0.01}};
    PrunedTree part;
    pruner.prune(pruner.whole(), box, false, {}, part);
    EXPECT_GT(part.size(), 1U);
    pruner.prune(pruner.whole(), box, true, {}, part);
    ASSERT_EQ(part.size(), 1U);
    EXPECT_FALSE(part[0].inside);
}

TEST(PrunedTree, LeavesKeepTheirRowsUnlessTheyAreSeveral) {
    SetTree tree;
    tree.low = {-2048, -2048, -2048}, tree.high = {2048, 2048, 2048};
    tree.nodes = {{.kind = TreeNode::Kind::cut, .high = 1, .low = 2, .cut = 0.25}, leaf(true), leaf(true)};
    const TreePruner pruner(tree);
    PrunedTree part;
    pruner.prune(pruner.whole(), {{0.5, 0, 0}, {0.6, 0.1, 0.1}}, true, {}, part);
    ASSERT_EQ(part.size(), 1U);
    EXPECT_EQ(part[0].leaf, 1);
    pruner.prune(pruner.whole(), {{0.2, 0, 0}, {0.6, 0.1, 0.1}}, true, {}, part);
    ASSERT_EQ(part.size(), 1U);
    EXPECT_EQ(part[0].leaf, -1);
    EXPECT_TRUE(part[0].inside);
}

}  // namespace
}  // namespace pfgeom
