#include "pfgeom/eval/solid_field.h"

#include "eval/random_functions.h"
#include "pfgeom/base/random.h"
#include "pfgeom/eval/model_field.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using Kind = SetNode::Kind;
using test::random_point;

Function ball(const Vec3& c, double r) {
    Function f;
    f.base = {{-1, -1, -1, 0, 0, 0, 2 * c.x, 2 * c.y, 2 * c.z, r * r - squared_norm(c)}};
    return f;
}

Model two_balls(const std::vector<SetNode>& nodes) {
    Model model;
    model.functions = {ball({-0.2, 0, 0}, 0.5), ball({0.2, 0, 0}, 0.5)};
    Object object;
    object.shape = Solid{nodes};
    model.objects = {object};
    model.diagonal = 2;
    return model;
}

bool in_ball(const Vec3& p, int which) {
    return norm(p - Vec3{which == 0 ? -0.2 : 0.2, 0, 0}) <= 0.5;
}

TEST(SolidField, SetOperationsAreThoseOfSets) {
    const SetNode a{Kind::function, 0, -1, -1}, b{Kind::function, 1, -1, -1};
    struct Case {
        std::vector<SetNode> nodes;
        bool (*truth)(bool, bool);
    };
    const std::vector<Case> cases{
        {{a, b, {Kind::unite, 0, 1, -1}}, [](bool x, bool y) { return x || y; }},
        {{a, b, {Kind::intersect, 0, 1, -1}}, [](bool x, bool y) { return x && y; }},
        {{a, b, {Kind::complement, 1, -1, -1}, {Kind::intersect, 0, 2, -1}},
         [](bool x, bool y) { return x && !y; }},
        {{b, {Kind::outside, -1, -1, -1}, {Kind::decide, 0, 1, 0}}, [](bool x, bool y) { return x && y; }},
        {{a, {Kind::inside, -1, -1, -1}, {Kind::unite, 0, 1, -1}}, [](bool, bool) { return true; }}};
    Random random(1);
    for (const Case& c : cases) {
        const Model model = two_balls(c.nodes);
        const SolidField field(model, std::get<Solid>(model.objects[0].shape));
        for (int n = 0; n < 3000; ++n) {
            const Vec3 p = random_point(random);
            EXPECT_EQ(field.value(p) >= 0, c.truth(in_ball(p, 0), in_ball(p, 1)));
            const Vec3 e{0.01, 0.01, 0.01};
            const Interval range = field.range({p - e, p + e});
            EXPECT_LE(range.lo, field.value(p));
            EXPECT_GE(range.hi, field.value(p));
        }
    }
}

TEST(ModelField, CavitiesAreTakenOutAndIslandsInsideThemCount) {
    Model model;
    model.functions = {ball({0, 0, 0}, 0.9), ball({0, 0, 0}, 0.6), ball({0, 0, 0}, 0.3)};
    model.diagonal = 2;
    for (std::int32_t i = 0; i < 3; ++i) {
        Object object;
        object.shape = Solid{{{Kind::function, i, -1, -1}}};
        object.cavity_of = i == 1 ? 0 : -1;
        model.objects.push_back(object);
    }
    const ModelField field(model);
    EXPECT_TRUE(field.contains({0.8, 0, 0}));
    EXPECT_FALSE(field.contains({0.5, 0, 0}));
    EXPECT_TRUE(field.contains({0.1, 0, 0}));
    EXPECT_FALSE(field.contains({5, 0, 0}));
    EXPECT_LT(dot(field.gradient({0.58, 0, 0}), Vec3{-1, 0, 0}), 0)
        << "outwards from the hollow is into the solid";
}

TEST(ModelField, InstancesAreCopies) {
    Model model;
    model.functions = {ball({0, 0, 0}, 0.5)};
    model.diagonal = 2;
    Object object;
    object.shape = Solid{{{Kind::function, 0, -1, -1}}};
    Similarity mirror_and_grow;
    mirror_and_grow.scale = 2;
    mirror_and_grow.rows = {{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
    mirror_and_grow.translation = {10, 0, 0};
    object.instances = {mirror_and_grow};
    model.objects = {object};
    const ModelField field(model);
    EXPECT_TRUE(field.contains({0.4, 0, 0}));
    EXPECT_TRUE(field.contains({10.9, 0, 0}));
    EXPECT_FALSE(field.contains({11.1, 0, 0}));
    EXPECT_TRUE(field.bounds().contains({10.9, 0.9, 0}));
}

// A pattern has no place of its own.
TEST(ModelField, APatternLiesWhereItsPlacementsAre) {
    Model model;
    model.functions = {ball({0.2, 0, 0}, 0.5)};
    model.diagonal = 2;
    Object object;
    object.shape = Solid{{{Kind::function, 0, -1, -1}}};
    object.placements.turn_steps = 1;
    object.placements.origin = {10, 0, 0};
    object.placements.list = {{{1, 0, 0, 0}, false, 1, {0, 0, 0}},   // as it is
                              {{1, 0, 0, 0}, true, 1, {5, 0, 0}},    // seen in a mirror
                              {{1, 0, 0, 1}, false, 2, {9, 1, 0}}};  // a quarter turn about z, twice as large
    ASSERT_EQ(find_flaw(object.placements), "");
    model.objects = {object};
    const ModelField field(model);
    EXPECT_FALSE(field.contains({0.2, 0, 0}));
    EXPECT_TRUE(field.contains({10.65, 0, 0}));
    EXPECT_FALSE(field.contains({9.6, 0, 0}));
    EXPECT_TRUE(field.contains({14.4, 0, 0}));
    EXPECT_FALSE(field.contains({15.4, 0, 0}));
    EXPECT_TRUE(field.contains({19, 2.3, 0}));
    EXPECT_GT(field.gradient({10.65, 0, 0}).x, -10);
    EXPECT_LT(field.gradient({14.4, 0, 0}).x * field.gradient({10.6, 0, 0}).x, 0) << "mirrored";
    EXPECT_TRUE(field.bounds().contains({18.1, 1, 0}));
    EXPECT_FALSE(field.bounds().contains({0, 0, 0}));
}

// Copies that are far are left out; the field is the same as that of as many objects.
TEST(ModelField, CopiesAreAsManyObjects) {
    Random random(12);
    Model placed;
    placed.functions = {ball({0.1, 0.2, 0}, 0.6)};
    placed.diagonal = 2;
    Object object;
    object.shape = Solid{{{Kind::function, 0, -1, -1}}};
    for (int i = 0; i < 20; ++i) {
        Similarity s;
        s.scale = 0.5 + random.uniform();
        s.translation = {6 * random.uniform(), 6 * random.uniform(), 6 * random.uniform()};
        object.instances.push_back(s);
    }
    placed.objects = {object};
    std::vector<ModelField> single;
    for (const Similarity& s : copies_of(object)) {
        Model one = placed;
        one.objects[0].instances = {s};
        single.emplace_back(one);
    }
    const ModelField field(placed);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p{8 * random.uniform() - 1, 8 * random.uniform() - 1, 8 * random.uniform() - 1};
        double expected = -1e300;
        Vec3 gradient;
        for (const ModelField& one : single) {
            const double value = one.value(p);
            if (value > expected) expected = value, gradient = one.gradient(p);
        }
        EXPECT_EQ(field.value(p), expected);
        EXPECT_EQ(field.gradient(p), gradient);
    }
}

}  // namespace
}  // namespace pfgeom
