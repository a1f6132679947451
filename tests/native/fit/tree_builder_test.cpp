#include "pfgeom/fit/tree_builder.h"

#include "pfgeom/function/quadric_family.h"
#include "pfgeom/mesh/signed_distance.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

QuantisedQuadric as_candidate(const Quadric& q, int resolution = 10) {
    const TreeQuadric fine = round_finely(q, resolution);
    return {fine, estimated_bits(fine)};
}

const Box kCube{{-1, -1, -1}, {1, 1, 1}};
constexpr double kTube = 0.01;

// Random points with the side and the patch that `side` gives: distance > 0 inside, and the quadric.
template <class Side>
std::vector<TreeSample> samples_of(std::size_t count, const Side& side) {
    Random random(11);
    std::vector<TreeSample> samples;
    while (samples.size() < count) {
        const auto coordinate = [&] { return 2 * random.uniform() - 1; };
        const Vec3 p{coordinate(), coordinate(), coordinate()};
        const auto [distance, patch] = side(p);
        if (std::abs(distance) >= kTube) samples.push_back({p, patch, distance > 0});
    }
    return samples;
}

int count_of(const RawTree& tree, TreeNode::Kind kind) {
    return static_cast<int>(std::ranges::count(tree.nodes, kind, &TreeNode::kind));
}

// |p| <= 0.5 and x <= 0.2: a ball with a flat side.
std::pair<double, std::int32_t> cut_ball(const Vec3& p) {
    const double ball = 0.5 - norm(p), plane = 0.2 - p.x;
    return ball < plane ? std::pair(ball, 0) : std::pair(plane, 1);
}
const std::vector<QuantisedQuadric> kCutBall{as_candidate({{-1, -1, -1, 0, 0, 0, 0, 0, 0, 0.25}}),
                                             as_candidate({{0, 0, 0, 0, 0, 0, -1, 0, 0, 0.2}}, 20)};

TEST(TreeBuilder, AsksEachQuadricOfAnIntersectionOnce) {
    const auto samples = samples_of(5000, cut_ball);
    const SampleTable table(samples, kCutBall, {});
    const RawTree tree = build_tree(table, kCutBall, kCube, {}, {});
    EXPECT_EQ(wrong_samples(tree, table), 0U);
    EXPECT_EQ(tree.forced, 0);
    EXPECT_EQ(count_of(tree, TreeNode::Kind::ask), 2);
    EXPECT_EQ(tree.nodes.size(), 5U);
}

TEST(TreeBuilder, SeparatesParallelSheetsThatNoQuestionGainsOn) {
    // |x| in [0.3, 0.5]: four planes, of which information gain would take none before a cut between them.
    const auto sheets = [](const Vec3& p) {
        const double x = std::abs(p.x);
        const std::int32_t side = p.x < 0 ? 0 : 2;
        return x - 0.3 < 0.5 - x ? std::pair(x - 0.3, side) : std::pair(0.5 - x, side + 1);
    };
    const std::vector<QuantisedQuadric> planes{as_candidate({{0, 0, 0, 0, 0, 0, -1, 0, 0, -0.3}}, 20),
                                               as_candidate({{0, 0, 0, 0, 0, 0, 1, 0, 0, 0.5}}, 20),
                                               as_candidate({{0, 0, 0, 0, 0, 0, 1, 0, 0, -0.3}}, 20),
                                               as_candidate({{0, 0, 0, 0, 0, 0, -1, 0, 0, 0.5}}, 20)};
    const auto samples = samples_of(5000, sheets);
    const SampleTable table(samples, planes, {});
    const RawTree tree = build_tree(table, planes, kCube, {}, {});
    EXPECT_EQ(wrong_samples(tree, table), 0U);
    EXPECT_LE(tree.nodes.size(), 11U);
}

TEST(TreeBuilder, AUnionIsAChainOfItsParts) {
    // Balls in a ring, each of which crosses its neighbours.
    constexpr int kBalls = 12;
    std::vector<QuantisedQuadric> balls;
    std::vector<Vec3> centres;
    for (int i = 0; i < kBalls; ++i) {
        const auto [c, s] = shapes::on_circle(static_cast<double>(i) / kBalls);
        centres.push_back({0.6 * c, 0.6 * s, 0});
        balls.push_back(as_candidate({{-1, -1, -1, 0, 0, 0, 1.2 * c, 1.2 * s, 0, 0.0625 - 0.36}}, 20));
    }
    const auto ring = [&](const Vec3& p) {
        std::pair<double, std::int32_t> nearest{-2, 0};
        for (std::int32_t i = 0; i < kBalls; ++i)
            nearest = std::max(nearest, {0.25 - norm(p - centres[static_cast<std::size_t>(i)]), i});
        return nearest;
    };
    const auto samples = samples_of(20000, ring);
    const SampleTable table(samples, balls, {});
    BuildOptions options;
    options.peel = true;
    const RawTree tree = build_tree(table, balls, kCube, options, {});
    EXPECT_EQ(wrong_samples(tree, table), 0U);
    EXPECT_EQ(tree.nodes.size(), 2U * kBalls + 1);
    EXPECT_EQ(count_of(tree, TreeNode::Kind::ask), kBalls);
}

TEST(TreeBuilder, ALongerLookIsNeverMuchWorse) {
    const auto samples = samples_of(5000, cut_ball);
    const SampleTable table(samples, kCutBall, {});
    BuildOptions look;
    look.tried = 6;
    EXPECT_LE(build_tree(table, kCutBall, kCube, look, {}).bits,
              build_tree(table, kCutBall, kCube, {}, {}).bits);
}

TEST(TreeBuilder, GivesUpWhatTakesTooMuch) {
    const SampleTable table(samples_of(5000, cut_ball), kCutBall, {});
    const double bits = build_tree(table, kCutBall, kCube, {}, {}).bits;
    BuildOptions options;
    options.most_bits = bits + 1;
    EXPECT_EQ(build_tree(table, kCutBall, kCube, options, {}).bits, bits);
    options.most_bits = bits;
    const RawTree none = build_tree(table, kCutBall, kCube, options, {});
    EXPECT_TRUE(none.nodes.empty());
    EXPECT_TRUE(std::isinf(none.bits));
}

TEST(TreeBuilder, RepairKeepsWhatIsRight) {
    const auto samples = samples_of(5000, cut_ball);
    const SampleTable table(samples, kCutBall, {});
    const RawTree tree = build_tree(table, kCutBall, kCube, {}, {});
    EXPECT_EQ(repair_tree(tree, table, kCutBall, kCube, {}, {}).nodes, tree.nodes);

    // A small void appears in the ball, far from every other sample's cell.
    auto more = samples;
    for (int i = 0; i < 20; ++i) more.push_back({{-0.2 + 0.001 * i, 0.1, 0.1}, 0, false});
    std::erase_if(more, [](const TreeSample& s) {
        return s.inside && norm(s.point - Vec3{-0.19, 0.1, 0.1}) < 0.08;
    });
    const SampleTable contradicting(more, kCutBall, {});
    EXPECT_GT(wrong_samples(tree, contradicting), 0U);
    const RawTree repaired = repair_tree(tree, contradicting, kCutBall, kCube, {}, {});
    EXPECT_EQ(wrong_samples(repaired, contradicting), 0U);
    EXPECT_EQ(repaired.nodes[0].kind, tree.nodes[0].kind);
    EXPECT_EQ(repaired.nodes[0].quadric, tree.nodes[0].quadric);
}

TEST(TreeBuilder, GivesUpOnContradictions) {
    std::vector<TreeSample> samples;
    for (const bool inside : {false, true}) samples.push_back({{0.1, 0.1, 0.1}, 0, inside});
    const SampleTable table(samples, kCutBall, {});
    const RawTree tree = build_tree(table, kCutBall, kCube, {}, {});
    EXPECT_EQ(tree.forced, 1);
    EXPECT_EQ(tree.nodes.size(), 1U);
}

}  // namespace
}  // namespace pfgeom
