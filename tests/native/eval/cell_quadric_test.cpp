#include "pfgeom/eval/cell_quadric.h"

#include "eval/random_functions.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using test::random_point;
using test::random_quadric;

TEST(CellQuadric, OctreeStepIsTheSubstitution) {
    Random random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        const Quadric q = random_quadric(random);
        const int i = random.below(2) != 0 ? 1 : -1, j = random.below(2) != 0 ? 1 : -1,
                  k = random.below(2) != 0 ? 1 : -1;
        const Quadric child = child_quadric(q, i, j, k);
        const Vec3 p = random_point(random);
        const Vec3 in_parent = p / 2 + Vec3{i / 2.0, j / 2.0, k / 2.0};
        EXPECT_NEAR(child.value(p), q.value(in_parent), 1e-12);
    }
}

TEST(CellQuadric, FrameOfABoxEqualsRepeatedSteps) {
    Random random(2);
    for (int trial = 0; trial < 200; ++trial) {
        const Quadric q = random_quadric(random);
        const Quadric stepped = child_quadric(child_quadric(q, 1, -1, 1), -1, -1, 1);
        const Vec3 c = Vec3{0.5, -0.5, 0.5} + Vec3{-0.25, -0.25, 0.25};
        const Quadric direct = in_frame_of(q, {c - Vec3{0.25, 0.25, 0.25}, c + Vec3{0.25, 0.25, 0.25}});
        for (std::size_t n = 0; n < 10; ++n) EXPECT_NEAR(stepped.c[n], direct.c[n], 1e-12);
    }
}

TEST(CellQuadric, RangeContainsValuesAndIsExactWithoutMixedTerms) {
    Random random(3);
    for (int trial = 0; trial < 500; ++trial) {
        Quadric q = random_quadric(random);
        if (trial % 2 == 0) q.c[3] = q.c[4] = q.c[5] = 0;
        const Interval range = cell_range(q);
        double lo = 1e300, hi = -1e300;
        for (int n = 0; n < 2000; ++n) {
            const double v = q.value(random_point(random));
            ASSERT_GE(v, range.lo);
            ASSERT_LE(v, range.hi);
            lo = std::min(lo, v);
            hi = std::max(hi, v);
        }
        if (trial % 2 == 0) {
            EXPECT_LT((range.hi - range.lo) - (hi - lo), 0.35 * (range.hi - range.lo));
        }
    }
}

TEST(CellQuadric, ClassificationIsNeverWrong) {
    Random random(4);
    int decided = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        Quadric q = random_quadric(random);
        q.c[9] *= 12;
        const int side = classify_cell(q);
        decided += side != 0;
        for (int n = 0; side != 0 && n < 50; ++n) EXPECT_GT(side * q.value(random_point(random)), 0);
    }
    EXPECT_GT(decided, 200);
}

}  // namespace
}  // namespace pfgeom
