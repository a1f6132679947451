#include "pfgeom/eval/pruned_function.h"

#include "eval/random_functions.h"

#include <gtest/gtest.h>

#include <vector>

namespace pfgeom {
namespace {

using test::between;
using test::random_point;

TEST(PrunedFunction, EqualsTheWholeBitForBitInsideTheBoxAndOut) {
    Random random(11);
    for (int trial = 0; trial < 20; ++trial) {
        const FunctionField whole(test::random_function(random));
        const double half = between(random, 0.01, 0.3);
        const Vec3 c = random_point(random), h{half, half, half};
        const PrunedFunction pruned(whole, {c - h, c + h});
        for (int n = 0; n < 1000; ++n) {
            const Vec3 p = c + random_point(random, 1.5) * half;
            ASSERT_EQ(pruned.value(p), whole.value(p));
            Vec3 one, other;
            ASSERT_EQ(pruned.value_and_gradient(p, one), whole.value_and_gradient(p, other));
            ASSERT_EQ(one, other);
        }
        for (int k = 0; k < 8; ++k) {  // the corners belong to it
            const Vec3 p{k & 1 ? c.x + half : c.x - half, k & 2 ? c.y + half : c.y - half,
                         k & 4 ? c.z + half : c.z - half};
            ASSERT_EQ(pruned.value(p), whole.value(p));
        }
    }
}

// Also where some of the points are out of the box, and where their number is odd.
TEST(PrunedFunction, ManyPointsAreAsEachAlone) {
    Random random(13);
    for (std::size_t trial = 0; trial < 40; ++trial) {
        const FunctionField whole(test::random_function(random));
        const double half = between(random, 0.01, 0.3);
        const Vec3 c = random_point(random), h{half, half, half};
        const PrunedFunction pruned(whole, {c - h, c + h});
        std::vector<Vec3> points(trial);
        std::vector<Box> boxes;
        for (Vec3& p : points) {
            p = c + random_point(random, trial % 2 == 0 ? 1 : 1.2) * half;
            boxes.push_back({p - h * 0.1, p + h * 0.1});
        }
        std::vector<double> values(trial), with_gradients(trial);
        std::vector<Vec3> gradients(trial);
        std::vector<Tangent> tangents(trial);
        pruned.values(points, values);
        pruned.values_and_gradients(points, with_gradients, gradients);
        pruned.tangents(boxes, tangents);
        for (std::size_t i = 0; i < trial; ++i) {
            Vec3 gradient;
            ASSERT_EQ(values[i], whole.value(points[i]));
            ASSERT_EQ(with_gradients[i], whole.value_and_gradient(points[i], gradient));
            ASSERT_EQ(gradients[i], gradient);
            const Tangent alone = pruned.tangent(boxes[i]);
            ASSERT_EQ(tangents[i].value, alone.value);
            ASSERT_EQ(tangents[i].gradient, alone.gradient);
            ASSERT_EQ(tangents[i].error, alone.error);
        }
    }
}

// Two balls that cancel: their second derivatives do, too, and a bound of the third ones is left.
TEST(PrunedFunction, TangentsKnowTheSecondDerivativesAtTheirPoint) {
    Function f;
    f.base.c[9] = 1;
    Level level;
    level.depth = 3;
    level.radius = 0.5;
    level.step = 1;
    level.scale = {1, 1};
    level.centres = {{0.1, 0, 0}, {0.1, 0, 0}};
    level.z = {1, -1};
    f.levels.push_back(level);
    const FunctionField whole(f);
    const Box box{{-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}};
    const PrunedFunction pruned(whole, box);
    EXPECT_LT(pruned.tangent(box).error, 0.2 * whole.tangent(box).error);
}

TEST(PrunedFunction, TangentsAreConservative) {
    Random random(12);
    for (int trial = 0; trial < 200; ++trial) {
        Function f = test::random_function(random);
        if (trial % 2 == 0) f.perturbations.clear();
        const FunctionField whole(f);
        const double half = between(random, 0.01, 0.2);
        const Vec3 c = random_point(random), h{half, half, half};
        const PrunedFunction pruned(whole, {c - h, c + h});
        const double small = half * between(random, 0.01, 1);
        const Vec3 s{small, small, small}, d = c + random_point(random) * (half - small);
        for (const ScalarField* field :
             {static_cast<const ScalarField*>(&whole), static_cast<const ScalarField*>(&pruned)}) {
            const Tangent tangent = field->tangent({d - s, d + s});
            const Interval range = field->range({d - s, d + s});
            for (int n = 0; n < 50; ++n) {
                const Vec3 off = random_point(random) * small;
                const double value = whole.value(d + off);
                ASSERT_LE(std::abs(value - tangent.value - dot(tangent.gradient, off)), tangent.error);
                ASSERT_LE(range.lo, value);
                ASSERT_GE(range.hi, value);
            }
        }
    }
}

}  // namespace
}  // namespace pfgeom
