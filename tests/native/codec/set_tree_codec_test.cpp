#include "pfgeom/codec/set_tree_codec.h"

#include "pfgeom/codec/tree_quadric_codec.h"
#include "pfgeom/function/check.h"
#include "pfgeom/function/quadric_family.h"
#include "random_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace pfgeom {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Kind = TreeNode::Kind;

Bytes encoded(SetTree tree) {
    CodecStream stream;
    BackoffModel model;
    code_set_tree(stream, model, tree);
    EXPECT_EQ(stream.status, FormatStatus::ok);
    return stream.coder.finish();
}

Result<SetTree> decoded(const Bytes& bytes) {
    CodecStream stream(bytes);
    BackoffModel model;
    SetTree tree;
    code_set_tree(stream, model, tree);
    if (stream.status != FormatStatus::ok) return stream.status;
    if (!stream.coder.ended_cleanly()) return FormatStatus::bad_stream;
    return tree;
}

void expect_round_trip(const SetTree& tree) {
    const Result<SetTree> back = decoded(encoded(tree));
    ASSERT_TRUE(back) << name(back.status());
    EXPECT_EQ(*back, tree);
}

TEST(SetTreeCodec, RoundTripOfRandomTrees) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        expect_round_trip(test::random_tree(random, 1 + static_cast<int>(seed % 7)));
    }
}

TEST(SetTreeCodec, RoundTripOfALeaf) {
    for (const bool inside : {false, true}) {
        SetTree tree = test::box_tree(10, 2049);
        tree.nodes = {test::leaf(inside)};
        expect_round_trip(tree);
        EXPECT_LE(encoded(tree).size(), 9U);
    }
}

// The high side of question i is a leaf, the low side question i + 1.
SetTree comb(int questions) {
    SetTree tree = test::box_tree(10, 1024);
    for (std::int32_t i = 0; i < questions; ++i) {
        TreeQuadric q;
        q.family = 3;
        q.linear_shift = 4;
        q.n = {i % 60 - 30, 17 * i % 63 - 31, 29 * i % 61 - 30, 13 * i % 101 - 50};
        tree.quadrics.push_back(q);
        TreeNode ask;
        ask.kind = Kind::ask;
        ask.quadric = i;
        tree.nodes.push_back(test::with_children(ask, 2 * i + 1, 2 * i + 2));
        tree.nodes.push_back(test::leaf(true));
    }
    tree.nodes.push_back(test::leaf(false));
    derive(tree);
    return tree;
}

TEST(SetTreeCodec, RoundTripOfTheDeepestTree) {
    const SetTree tree = comb(kMaxTreeDepth);
    EXPECT_EQ(find_flaw(tree), "");
    expect_round_trip(tree);
}

// A union is a comb: its structure costs next to nothing beside its quadrics.
TEST(SetTreeCodec, AUnionCostsLittleMoreThanItsQuadrics) {
    SetTree tree = comb(100);
    CodecStream quadrics;
    BackoffModel model;
    TreeQuadricCoder coder(quadrics, model);
    for (std::size_t i = 0; i < tree.quadrics.size(); ++i) coder.code(tree.quadrics, i, tree.resolution);
    EXPECT_LE(static_cast<double>(encoded(tree).size()), quadrics.coder.bits_so_far() / 8 + 24);
}

// References further back than the list, and more quadrics than the bytes account for.
TEST(SetTreeCodec, RoundTripOfManyQuadricsAndFarReferences) {
    SetTree tree = test::box_tree(10, 1024);
    const std::function<std::int32_t(int, std::int32_t)> fill = [&](int depth, std::int32_t last) {
        const auto index = static_cast<std::int32_t>(tree.nodes.size());
        tree.nodes.push_back(test::leaf(true));
        if (depth == 0) return index;
        TreeNode ask;
        ask.kind = Kind::ask;
        ask.quadric =
            depth == 1 && tree.quadrics.size() > 300 ? last : static_cast<std::int32_t>(tree.quadrics.size());
        if (ask.quadric == static_cast<std::int32_t>(tree.quadrics.size())) {
            TreeQuadric q;
            q.n = {1, 0};
            tree.quadrics.push_back(q);
        }
        ask.high = fill(depth - 1, 7);
        ask.low = fill(depth - 1, 8);
        tree.nodes[static_cast<std::size_t>(index)] = ask;
        return index;
    };
    fill(10, 0);
    derive(tree);
    ASSERT_EQ(find_flaw(tree), "");
    ASSERT_GT(tree.quadrics.size(), 500U);
    expect_round_trip(tree);
}

// A small sphere anywhere: its constant follows from the rest, up to the freedom of its scale.
TEST(SetTreeCodec, PlaceOfASmallSphereDoesNotCostTwice) {
    const auto bits_of_sphere_at = [](double centre) {
        constexpr double kRadius = 1.0 / 32, kSquare = 0.5 / kRadius;  // slope 1
        TreeQuadric q;
        q.family = 7;
        q.linear_shift = 4;
        q.square_shift = 2;
        q.n = {-static_cast<std::int32_t>(kSquare * 16), static_cast<std::int32_t>(2 * kSquare * centre * 64),
               0, 0, static_cast<std::int32_t>(kSquare * (kRadius * kRadius - centre * centre) * 1024)};
        CodecStream stream;
        BackoffModel model;
        TreeQuadricCoder(stream, model).code({&q, 1}, 0, 10);
        return stream.coder.bits_so_far();
    };
    // The linear term alone: from 0 to about 1,500 of its units.
    EXPECT_LE(bits_of_sphere_at(0.75), bits_of_sphere_at(0) + 14);
}

// Mirrored and moved along an axis.
TEST(SetTreeCodec, AQuadricLikeAnEarlierOneCostsLittle) {
    TreeQuadric cylinder;
    cylinder.family = 4;
    cylinder.linear_shift = 6;
    cylinder.square_shift = 2;
    cylinder.n = {-43, 173, 291, -14345};
    std::vector<TreeQuadric> quadrics{cylinder, cylinder, cylinder};
    quadrics[1].n[1] = -173;
    quadrics[2].n[2] = 77;
    CodecStream stream;
    BackoffModel model;
    TreeQuadricCoder coder(stream, model);
    std::vector<double> bits{0};
    for (std::size_t i = 0; i < quadrics.size(); ++i) {
        coder.code(quadrics, i, 10);
        bits.push_back(stream.coder.bits_so_far());
    }
    EXPECT_LE(bits[2] - bits[1], 0.3 * bits[1]);
    EXPECT_LE(bits[3] - bits[2], 0.6 * bits[1]);
}

TEST(SetTreeCodec, TruncatedStreamsNeverPassForTheWhole) {
    Random random(4);
    const SetTree tree = test::random_tree(random, 6);
    const Bytes bytes = encoded(tree);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        const Result<SetTree> part = decoded({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)});
        EXPECT_FALSE(part && *part == tree) << n;
    }
}

TEST(SetTreeCodec, DamagedStreamsGiveAStatusOrAWellFormedTree) {
    Random random(5);
    int trees = 0;
    for (int i = 0; i < 3000; ++i) {
        Bytes bytes = encoded(test::random_tree(random, 5));
        bytes[random.below(bytes.size())] ^= static_cast<std::uint8_t>(1U << random.below(8));
        const Result<SetTree> tree = decoded(bytes);
        if (!tree) continue;
        ++trees;
        EXPECT_EQ(find_flaw(*tree), "") << i;
        for (const TreeQuadric& q : tree->quadrics) {
            for (const double c : q.quadric.c) EXPECT_TRUE(std::isfinite(c));
        }
    }
    EXPECT_GT(trees, 0);
}

TEST(SetTreeCodec, RandomBytesGiveAStatusOrAWellFormedTree) {
    Random random(6);
    for (int i = 0; i < 3000; ++i) {
        Bytes bytes(random.below(200));
        for (auto& b : bytes) b = static_cast<std::uint8_t>(random.next());
        const Result<SetTree> tree = decoded(bytes);
        if (tree) {
            EXPECT_EQ(find_flaw(*tree), "") << i;
        }
    }
}

// Long runs of one byte drive the adaptive bits to their cheapest: trees stay in proportion all the same.
TEST(SetTreeCodec, NodesAndQuadricsStayInProportionToTheBytes) {
    for (int value = 0; value < 256; ++value) {
        for (const std::size_t size : {100U, 2000U}) {
            const Bytes bytes(size, static_cast<std::uint8_t>(value));
            CodecStream stream(bytes);
            BackoffModel model;
            SetTree tree;
            code_set_tree(stream, model, tree);
            EXPECT_LE(tree.nodes.size(), 1024 + 10 * (size + 8)) << value;
            EXPECT_LE(tree.quadrics.size(), 64 + 3 * (size + 8)) << value;
        }
    }
}

}  // namespace
}  // namespace pfgeom
