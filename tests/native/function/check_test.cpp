#include "pfgeom/function/check.h"

#include "codec/random_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

using test::ball;

template <class Change>
std::string flaw_after(Change change) {
    Model model = ball();
    change(model);
    return find_flaw(model);
}

TEST(Check, GoodModelsHaveNoFlaw) {
    EXPECT_EQ(find_flaw(ball()), "");
    for (std::uint64_t seed = 0; seed < 100; ++seed)
        EXPECT_EQ(find_flaw(test::random_model(seed)), "") << seed;
}

TEST(Check, NumbersMustBeFinite) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                     kInf = std::numeric_limits<double>::infinity();
    for (const double bad : {kNan, kInf, -kInf, 1e61}) {
        EXPECT_NE(flaw_after([bad](Model& m) { m.functions[0].base.c[9] = bad; }), "");
        EXPECT_NE(flaw_after([bad](Model& m) { m.functions[0].perturbations.push_back({bad, {}}); }), "");
    }
    for (const double bad : {kNan, kInf, -1.0}) {
        EXPECT_NE(flaw_after([bad](Model& m) { m.diagonal = bad; }), "");
        EXPECT_NE(flaw_after([bad](Model& m) { m.promise.tolerance = bad; }), "");
        EXPECT_NE(flaw_after([bad](Model& m) { m.promise.rms = bad; }), "");
        EXPECT_NE(flaw_after([bad](Model& m) { m.promise.bound_functions = bad; }), "");
        EXPECT_NE(flaw_after([bad](Model& m) { m.objects[0].instances.push_back({bad, {}, {}}); }), "");
    }
    EXPECT_NE(flaw_after([](Model& m) { m.diagonal = 0; }), "");
}

TEST(Check, OnlyAKnownBoundCanBeCertified) {
    EXPECT_NE(flaw_after([](Model& m) { m.promise.functions_certified = true; }), "");
    EXPECT_EQ(flaw_after([](Model& m) {
                  m.promise.bound_functions = 1e-3;
                  m.promise.functions_certified = true;
              }),
              "");
}

TEST(Check, IndicesMustExist) {
    using Kind = SetNode::Kind;
    const auto with_node = [](SetNode node) {
        return flaw_after([node](Model& m) { std::get<Solid>(m.objects[0].shape).nodes.push_back(node); });
    };
    EXPECT_EQ(with_node({Kind::complement, 0, -1, -1}), "");
    EXPECT_EQ(with_node({Kind::decide, 0, 0, 0}), "");
    EXPECT_NE(with_node({Kind::complement, 1, -1, -1}), "") << "a node is its own child";
    EXPECT_NE(with_node({Kind::unite, 0, -1, -1}), "");
    EXPECT_NE(with_node({Kind::function, 1, -1, -1}), "");
    EXPECT_NE(with_node({Kind::decide, 0, 0, 1}), "");
    EXPECT_NE(with_node({static_cast<Kind>(7), 0, 0, 0}), "");
    EXPECT_NE(flaw_after([](Model& m) { m.objects[0].shape = Solid{}; }), "");
    EXPECT_NE(flaw_after([](Model& m) { m.objects[0].shape = Sheet{0, 1, {}}; }), "");
    const MaterialTree kept = plain_paint(Sheet::kKept).trees.front(), third = plain_paint(2).trees.front();
    EXPECT_EQ(flaw_after([&](Model& m) { m.objects[0].shape = Sheet{0, -1, kept}; }), "");
    EXPECT_NE(flaw_after([&](Model& m) { m.objects[0].shape = Sheet{1, -1, kept}; }), "");
    EXPECT_NE(flaw_after([&](Model& m) { m.objects[0].shape = Sheet{0, 0, kept}; }), "");
    EXPECT_NE(flaw_after([&](Model& m) { m.objects[0].shape = Sheet{0, -1, third}; }), "");
    EXPECT_NE(flaw_after([&](Model& m) { m.objects[0].shape = Sheet{0, -1, {}}; }), "");
    EXPECT_NE(flaw_after([](Model& m) {
                  m.objects[0].shape = MeshPart{0, {{0, 0, 0}}, {{0, 0, 1}}, 0, {}};
              }),
              "");
    EXPECT_NE(flaw_after([](Model& m) {
                  m.objects[0].shape = MeshPart{0, {{0, 0, 1 << 27}}, {}, 0, {}};
              }),
              "");
    const MeshPart one_face{0, {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, {{0, 1, 2}}, 0, {{1, 0}, {0, 0}, {0, 2}}};
    EXPECT_EQ(flaw_after([&](Model& m) { m.objects[0].shape = one_face; }), "");
    MeshPart too_few = one_face, too_large = one_face;
    too_few.bulges.pop_back();
    too_large.bulges[2].sideways = -(1 << 27);
    EXPECT_NE(flaw_after([&](Model& m) { m.objects[0].shape = too_few; }), "");
    EXPECT_NE(flaw_after([&](Model& m) { m.objects[0].shape = too_large; }), "");
}

// A chain of 60,000 overflowed the stack of whoever followed it, 30 squares of one another took forever.
TEST(Check, SetExpressionsAreNeitherDeepNorLong) {
    using Kind = SetNode::Kind;
    const auto with_nodes = [](int count, Kind kind, bool squared) {
        return flaw_after([=](Model& m) {
            std::vector<SetNode>& nodes = std::get<Solid>(m.objects[0].shape).nodes;
            for (int i = 0; i < count; ++i) {
                const auto last = static_cast<std::int32_t>(nodes.size()) - 1;
                nodes.push_back({kind, last, squared ? last : 0, 0});
            }
        });
    };
    EXPECT_EQ(with_nodes(511, Kind::intersect, false), "");
    EXPECT_NE(with_nodes(512, Kind::intersect, false), "");
    EXPECT_NE(with_nodes(512, Kind::complement, false), "");
    EXPECT_EQ(with_nodes(15, Kind::unite, true), "");
    EXPECT_NE(with_nodes(30, Kind::unite, true), "");
    EXPECT_NE(with_nodes(30, Kind::decide, true), "");
}

TEST(Check, HalvesOfMirroredPartsMeetOnThePlane) {
    MeshPart half{0, {{0, 0, 0}, {9, 0, 0}, {0, 9, 1}}, {{0, 1, 2}}, 0, {{1, 0}, {0, 1}, {0, 2}}};
    const auto flaw_of = [](const MeshPart& part) {
        return flaw_after([&](Model& m) { m.objects[0].shape = part; });
    };
    const auto with = [&](std::int32_t axis, double at) {
        MeshPart part = half;
        part.mirror = MirrorPlane{axis, at};
        return part;
    };
    EXPECT_EQ(flaw_of(with(2, 0.5)), "");
    EXPECT_NE(flaw_of(with(3, 0)), "");
    EXPECT_NE(flaw_of(with(-1, 0)), "");
    EXPECT_NE(flaw_of(with(2, -1.5)), "");
    EXPECT_NE(flaw_of(with(2, std::numeric_limits<double>::quiet_NaN())), "");
    half.positions[2][2] = 0;
    EXPECT_NE(flaw_of(with(2, 0)), "") << "a face in the plane";
    half.positions[2][2] = 1;
    half.bulges[0].sideways = 1;
    EXPECT_NE(flaw_of(with(2, 0)), "") << "a bulge out of it";
    EXPECT_EQ(flaw_of(half), "");
}

TEST(Check, NestingMustNotBeACircle) {
    const auto nested = [](std::vector<std::int32_t> outer) {
        return flaw_after([&outer](Model& m) {
            m.objects.resize(outer.size(), m.objects[0]);
            for (std::size_t i = 0; i < outer.size(); ++i) m.objects[i].cavity_of = outer[i];
        });
    };
    EXPECT_EQ(nested({-1, 0, 1, 1, 0}), "");
    EXPECT_EQ(nested({1, 2, -1}), "");
    EXPECT_NE(nested({0}), "");
    EXPECT_NE(nested({1, 0}), "");
    EXPECT_NE(nested({-1, 2, 3, 1}), "");
    EXPECT_NE(nested({1}), "");
    EXPECT_NE(nested({-2}), "");
}

TEST(Check, InstancesMustBeSimilarities) {
    const auto with = [](const Similarity& s) {
        return flaw_after([&s](Model& m) { m.objects[0].instances = {s}; });
    };
    EXPECT_EQ(with({}), "");
    EXPECT_EQ(with({2, {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}, {}}), "") << "a mirror";
    EXPECT_NE(with({1, {{{1, 0, 0}, {1, 0, 0}, {0, 0, 1}}}, {}}), "");
    EXPECT_NE(with({1, {{{1, 0, 0}, {0, 1.1, 0}, {0, 0, 1}}}, {}}), "");
    EXPECT_NE(with({0, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}}), "");
    EXPECT_NE(with({1, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {NAN, 0, 0}}), "");
}

TEST(Check, FramesMustBeInRange) {
    EXPECT_NE(flaw_after([](Model& m) { m.objects[0].frame.scale_code = Frame::kMaxScale + 1; }), "");
    EXPECT_NE(flaw_after([](Model& m) { m.objects[0].frame.offset[1] = Frame::kMaxOffset + 1; }), "");
}

TEST(Check, OptionalMembers) {
    EXPECT_NE(flaw_after([](Model& m) { m.names = {"a", "b"}; }), "");
    EXPECT_NE(flaw_after([](Model& m) { m.names = {std::string(256, 'a')}; }), "");
    EXPECT_NE(flaw_after([](Model& m) { m.names = {"\xFF"}; }), "");
    EXPECT_NE(flaw_after([](Model& m) { m.world_transform.assign(12, 0); }), "");
    EXPECT_NE(flaw_after([](Model& m) { m.world_transform.assign(16, 1); }), "");
    EXPECT_NE(flaw_after([](Model& m) { m.face_groups = {0, -1}; }), "");
}

TEST(Check, TheSentenceNamesTheRow) {
    Model model = ball();
    model.objects.resize(3, model.objects[0]);
    model.objects[2].frame.scale_code = 100000;
    EXPECT_NE(find_flaw(model).find("object 2"), std::string::npos);
}

}  // namespace
}  // namespace pfgeom
