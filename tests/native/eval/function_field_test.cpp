#include "pfgeom/eval/function_field.h"

#include "eval/random_functions.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using test::random_function;
using test::random_point;

// The definition, ball by ball (paper eq. 4, 5).
double reference_value(const Function& f, const Vec3& p) {
    double sum = f.base.value(p);
    for (const Perturbation& r : f.perturbations) {
        const double q = r.quadric.value(p);
        if (q > 0) sum += r.factor * (q * q * q);
    }
    for (const Level& level : f.levels) {
        for (std::size_t i = 0; i < level.z.size(); ++i) {
            const double q = 1 - squared_norm(p - level.centres[i]) * (1 / (level.radius * level.radius));
            if (q > 0 && level.z[i] != 0) sum += level.factor(i) * (q * q * q);
        }
    }
    return sum;
}

TEST(FunctionField, EqualsTheDefinitionBitForBit) {
    Random random(5);
    for (int trial = 0; trial < 10; ++trial) {
        const Function f = random_function(random);
        const FunctionField field(f);
        for (int n = 0; n < 2000; ++n) {
            const Vec3 p = random_point(random, 1.3);
            ASSERT_EQ(field.value(p), reference_value(f, p));
            Vec3 gradient;
            ASSERT_EQ(field.value_and_gradient(p, gradient), field.jet(p).value);
            ASSERT_NEAR(field.value(p), field.jet(p).value, 1e-13);
        }
    }
}

TEST(FunctionField, BatchEqualsPoints) {
    Random random(6);
    const FunctionField field(random_function(random));
    std::vector<Vec3> points(5000);
    for (Vec3& p : points) p = random_point(random);
    std::vector<double> values(points.size());
    field.values(points, values);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(values[i], field.value(points[i]));
}

TEST(FunctionField, GradientIsTheDifferenceQuotient) {
    Random random(7);
    const FunctionField field(random_function(random));
    constexpr double kStep = 1e-6;
    for (int n = 0; n < 2000; ++n) {
        const Vec3 p = random_point(random);
        const Vec3 g = field.jet(p).gradient;
        for (int d = 0; d < 3; ++d) {
            Vec3 a = p, b = p;
            a[d] -= kStep;
            b[d] += kStep;
            EXPECT_NEAR((field.value(b) - field.value(a)) / (2 * kStep), g[d], 1e-6);
        }
    }
}

TEST(FunctionField, RangeContainsTheValues) {
    Random random(8);
    for (int trial = 0; trial < 5; ++trial) {
        const FunctionField field(random_function(random));
        for (int n = 0; n < 2000; ++n) {
            const double size = std::ldexp(1.0, -static_cast<int>(random.below(8)));
            const Vec3 corner = random_point(random);
            const Box box{corner, corner + Vec3{size, size * random.uniform(), size}};
            const Interval range = field.range(box);
            for (int k = 0; k < 20; ++k) {
                const Vec3 u{random.uniform(), random.uniform(), random.uniform()};
                const Vec3 e = box.extent();
                const double v = field.value(box.lo + Vec3{u.x * e.x, u.y * e.y, u.z * e.z});
                ASSERT_GE(v, range.lo);
                ASSERT_LE(v, range.hi);
            }
        }
    }
}

TEST(FunctionField, RangeIsTightInSmallCells) {
    Random random(9);
    const FunctionField field(random_function(random));
    for (int n = 0; n < 500; ++n) {
        const Vec3 p = random_point(random);
        const double h = 1e-4;
        const Interval range = field.range({p - Vec3{h, h, h}, p + Vec3{h, h, h}});
        const Vec3 g = field.jet(p).gradient;
        const double swing = 2 * h * (std::abs(g.x) + std::abs(g.y) + std::abs(g.z));
        EXPECT_LT(range.hi - range.lo, 1.2 * swing + 5e-5);
    }
}

TEST(FunctionField, CurvatureOfASphere) {
    const double r = 0.7;
    const FunctionField field(Quadric{{-1, -1, -1, 0, 0, 0, 0, 0, 0, r * r}});
    EXPECT_NEAR(field.curvature({r, 0, 0}), -2 / r, 1e-12);
    EXPECT_NEAR(field.curvature(Vec3{1, 2, 2} * (r / 3)), -2 / r, 1e-12);
}

}  // namespace
}  // namespace pfgeom
