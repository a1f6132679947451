#include "pfgeom/mesh/angle.h"

#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(Angle, AgreesWithTheLibrary) {
    Random random(1);
    for (int i = 0; i < 100'000; ++i) {
        const double size = i % 3 ? 1 : 1e-9;
        const double y = (random.uniform() - 0.5) * size, x = random.uniform() - 0.5;
        const double truth = std::atan2(y, x);
        EXPECT_NEAR(reproducible_atan2(y, x), truth, 5e-16 * std::abs(truth));
    }
}

TEST(Angle, AxesAndDiagonals) {
    EXPECT_EQ(reproducible_atan2(0, 0), 0);
    EXPECT_EQ(reproducible_atan2(0, 2), 0);
    EXPECT_DOUBLE_EQ(reproducible_atan2(0, -2), kPi);
    EXPECT_DOUBLE_EQ(reproducible_atan2(3, 0), kPi / 2);
    EXPECT_DOUBLE_EQ(reproducible_atan2(-3, 0), -kPi / 2);
    EXPECT_DOUBLE_EQ(reproducible_atan2(-1, -1), -3 * kPi / 4);
    EXPECT_DOUBLE_EQ(angle_between({1, 0, 0}, {0, 5, 0}), kPi / 2);
    EXPECT_DOUBLE_EQ(angle_between({1, 0, 0}, {-2, 0, 0}), kPi);
    EXPECT_EQ(angle_between({1, 2, 3}, {}), 0);
}

}  // namespace
}  // namespace pfgeom
