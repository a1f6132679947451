#include "pfgeom/eval/pruned_function.h"

#include "eval/random_functions.h"

#include <gtest/gtest.h>

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
