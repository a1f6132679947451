#include "pfgeom/codec/quantize.h"

#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

// Over many octaves.
double wide(Random& random) {
    return std::ldexp(1 + random.uniform(), static_cast<int>(random.below(200)) - 100);
}

TEST(ShortFloat, RoundsUpToItsGrid) {
    Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const double x = wide(random);
        for (const int bits : {5, 16}) {
            const ShortFloat code = short_float_above(x, bits);
            const double y = value_of(code, bits);
            EXPECT_GE(y, x * (1 - 1e-13));
            EXPECT_LE(y, x * (1 + std::ldexp(1.0, -bits)));
            EXPECT_EQ(short_float_above(y, bits), code);
            EXPECT_GE(code.mantissa, 1U << bits);
            EXPECT_LT(code.mantissa, 2U << bits);
        }
    }
    EXPECT_EQ(value_of(short_float_above(0, 5), 5), 0);
    EXPECT_EQ(value_of(short_float_above(std::nextafter(1.0, 0.0), 5), 5), 1);
    EXPECT_EQ(value_of(short_float_above(std::nextafter(1.0, 2.0), 5), 5), 1);
}

TEST(Decimal, KnowsWhatPeopleWrite) {
    for (int digits = 1; digits <= 999; ++digits) {
        for (int exponent = -12; exponent <= 12; ++exponent) {
            const double x =
                exponent < 0 ? digits / std::pow(10.0, -exponent) : digits * std::pow(10.0, exponent);
            const auto decimal = as_decimal(x);
            ASSERT_TRUE(decimal) << x;
            EXPECT_EQ(value_of(*decimal), x);
            EXPECT_NE(decimal->digits % 10, 0) << x;
        }
    }
    for (const double x : {1.0 / 3, 0.12345, 1e-20, 1e30, std::nextafter(0.1, 1.0) + 1e-12})
        EXPECT_FALSE(as_decimal(x));
}

TEST(Scaled, IsExact) {
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> values(1 + random.below(10));
        for (double& v : values) v = static_cast<double>(random.below(2000)) / 64 - 10;
        const auto scaled = as_scaled(values);
        ASSERT_TRUE(scaled);
        std::int64_t all = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            EXPECT_EQ(std::ldexp(static_cast<double>(scaled->integers[k]), scaled->exponent), values[k]);
            all |= scaled->integers[k];
        }
        EXPECT_TRUE(all == 0 || (all & 1) != 0) << "the exponent could be larger";
    }
}

TEST(Scaled, IsEmptyWhereIntegersWouldBeTooLarge) {
    EXPECT_FALSE(as_scaled(std::vector<double>{1e300, 1e-300}));
    EXPECT_FALSE(as_scaled(std::vector<double>{0x1p62, 1}));
    EXPECT_TRUE(as_scaled(std::vector<double>{0x1p61, 1}));
    EXPECT_TRUE(as_scaled(std::vector<double>{5e-324, 0, -5e-324}));
    EXPECT_EQ(as_scaled(std::vector<double>{0, 0})->exponent, 0);
}

}  // namespace
}  // namespace pfgeom
