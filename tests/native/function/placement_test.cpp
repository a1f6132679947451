#include "pfgeom/function/placement.h"

#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

std::array<double, 4> as_doubles(const std::array<std::int32_t, 4>& q) {
    return {static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]),
            static_cast<double>(q[3])};
}

std::array<Vec3, 3> random_rotation(Random& random) {
    const auto any = [&] { return 2 * random.uniform() - 1; };
    return rotation_of({any(), any(), any(), any()});
}

// The sine of half the angle between two rotations, times two: how far a point at distance one moves at most.
double between(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    double trace = 0;
    for (std::size_t i = 0; i < 3; ++i) trace += dot(a[i], b[i]);
    return std::sqrt(std::max(0.0, 3 - trace));
}

TEST(Placement, RotationsAreOrthonormal) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto rows = random_rotation(random);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(squared_norm(rows[k]), 1, 1e-14);
        EXPECT_NEAR(dot(rows[0], cross(rows[1], rows[2])), 1, 1e-14);
    }
}

// Three components are off by 1/2 step each, the quaternion is at least as long as its largest component, and
// an angle is twice that of the quaternion: √3 / steps.
TEST(Placement, TurnsAreRoundedByAStepAtMost) {
    Random random(2);
    for (const std::int32_t steps : {1, 2, 7, 100, 4096, 1 << 20}) {
        for (int i = 0; i < 500; ++i) {
            const auto rows = random_rotation(random);
            const auto turn = quantise_turn(rows, steps);
            // At the coarsest steps the bound is beyond half a turn.
            EXPECT_LE(between(rotation_of(as_doubles(turn)), rows), 1.8 / steps + 1e-7);
            EXPECT_EQ(quantise_turn(rotation_of(as_doubles(turn)), steps), turn) << "nothing moves twice";
        }
    }
}

TEST(Placement, QuarterTurnsAreExact) {
    const std::array<std::array<Vec3, 3>, 3> exact{{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                                    {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}},
                                                    {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}}};
    for (const auto& rows : exact) {
        for (const std::int32_t steps : {1, 5}) {
            EXPECT_LE(between(rotation_of(as_doubles(quantise_turn(rows, steps))), rows), 0);
        }
    }
}

Placements some() {
    Placements p;
    p.turn_steps = 12;
    p.scale_steps = 10;
    p.step_code = -16;
    p.origin = {100, -50, 7};
    p.list = {{{12, 4, -2, 0}, false, 10, {30, 4, 9}},
              {{-6, 0, 12, 2}, true, 5, {20, 8, 3}},
              {{12, 4, -2, 0}, true, 20, {25, 8, 3}}};
    return p;
}

TEST(Placement, TheNormalFormKeepsTheCopies) {
    const Placements given = some();
    Placements p = given;
    normalise(p);
    EXPECT_EQ(find_flaw(p), "");
    EXPECT_NE(find_flaw(given), "");
    EXPECT_EQ(p.turn_steps, 6);
    EXPECT_EQ(p.scale_steps, 2);
    const std::array<std::size_t, 3> order{1, 2, 0};  // by x
    const Vec3 centre{0.3, -2, 1};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(p.similarity(i, centre), given.similarity(order[i], centre));
    Placements again = p;
    normalise(again);
    EXPECT_EQ(again, p);
}

TEST(Placement, TheCentreComesToItsPlace) {
    const Placements p = some();
    const Vec3 centre{0.3, -2, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        const Similarity s = p.similarity(i, centre);
        const Vec3 expected =
            0.25 * Vec3{100.0 + p.list[i].place[0], -50.0 + p.list[i].place[1], 7.0 + p.list[i].place[2]};
        EXPECT_LE(norm(s.apply(centre) - expected), 1e-13);
        EXPECT_EQ(dot(s.rows[0], cross(s.rows[1], s.rows[2])) < 0, p.list[i].mirrored);
        EXPECT_EQ(s.scale, p.list[i].scale / 10.0);
    }
}

TEST(Placement, EveryOtherFormHasAFlaw) {
    Placements good = some();
    normalise(good);
    const auto flaw = [&good](auto change) {
        Placements p = good;
        change(p);
        return find_flaw(p);
    };
    EXPECT_EQ(flaw([](Placements&) {}), "");
    EXPECT_NE(flaw([](Placements& p) { p.list.clear(); }), "") << "steps of nothing";
    EXPECT_NE(flaw([](Placements& p) { std::swap(p.list[0], p.list[2]); }), "");
    EXPECT_NE(flaw([](Placements& p) { p.list[1].turn[1] = 7; }), "") << "beyond the steps";
    EXPECT_NE(flaw([](Placements& p) { p.list[1].turn[2] = INT32_MIN; }), "");
    EXPECT_NE(flaw([](Placements& p) { p.list[1].turn = {-6, 2, -1, 0}; }), "") << "the other sign";
    EXPECT_NE(flaw([](Placements& p) { p.list[0].place[0] = -1; }), "");
    EXPECT_NE(flaw([](Placements& p) { p.scale_steps = 0; }), "");
}

TEST(Similarity, ComposesAndInverts) {
    Random random(4);
    const auto any = [&] { return 4 * random.uniform() - 2; };
    for (int i = 0; i < 200; ++i) {
        Similarity a{0.5 + random.uniform(), random_rotation(random), {any(), any(), any()}};
        const Similarity b{0.5 + random.uniform(), random_rotation(random), {any(), any(), any()}};
        if (i % 2 == 0) a.rows[2] = -a.rows[2];
        const Vec3 p{any(), any(), any()};
        EXPECT_LE(norm(composed(a, b).apply(p) - a.apply(b.apply(p))), 1e-13);
        EXPECT_LE(norm(inverse_of(a).apply(a.apply(p)) - p), 1e-13);
    }
}

}  // namespace
}  // namespace pfgeom
