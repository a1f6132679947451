#include "pfgeom/codec/quantize.h"

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>

namespace pfgeom {
namespace {

// Exact up to 10^22.
double power_of_ten(int exponent) {
    double result = 1;
    for (int i = 0; i < exponent; ++i) result *= 10;
    return result;
}

// x = integer · 2^exponent with an odd integer. x != 0, finite.
struct Odd {
    std::int64_t integer = 0;
    int exponent = 0;
};
Odd as_odd(double x) {
    int exponent = 0;
    const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(significand));
    return {significand / (std::int64_t{1} << zeros), exponent - 53 + zeros};
}

}  // namespace

ShortFloat short_float_above(double x, int bits) {
    if (x <= 0) return {};
    int exponent = 0;
    const double scaled = std::ldexp(std::frexp(x, &exponent), bits + 1);  // in [2^bits, 2^(bits+1))
    const auto mantissa = static_cast<std::uint32_t>(std::ceil(scaled - scaled * 0x1p-44));
    if (mantissa == 2U << bits) return {exponent, 1U << bits};
    return {exponent - 1, std::max(mantissa, 1U << bits)};
}

double value_of(const ShortFloat& x, int bits) {
    return std::ldexp(static_cast<double>(x.mantissa), x.exponent - bits);
}

std::optional<Decimal> as_decimal(double x) {
    for (int exponent = Decimal::kMaxExponent; exponent >= Decimal::kMinExponent; --exponent) {
        const double digits =
            std::floor((exponent >= 0 ? x / power_of_ten(exponent) : x * power_of_ten(-exponent)) + 0.5);
        if (digits > Decimal::kMaxDigits) return {};
        if (digits < 1) continue;
        const Decimal decimal{static_cast<int>(digits), exponent};
        if (std::abs(value_of(decimal) - x) <= 1e-12 * x) return decimal;
    }
    return {};
}

double value_of(const Decimal& x) {
    return x.exponent >= 0 ? x.digits * power_of_ten(x.exponent) : x.digits / power_of_ten(-x.exponent);
}

std::optional<Scaled> as_scaled(std::span<const double> values) {
    Scaled scaled;
    int lowest = INT_MAX;
    for (const double v : values) {
        if (v != 0) lowest = std::min(lowest, as_odd(v).exponent);
    }
    scaled.exponent = lowest == INT_MAX ? 0 : lowest;
    for (const double v : values) {
        if (std::abs(std::ldexp(v, -scaled.exponent)) >= 0x1p62) return {};
        scaled.integers.push_back(
            v == 0 ? 0 : as_odd(v).integer * (std::int64_t{1} << (as_odd(v).exponent - lowest)));
    }
    return scaled;
}

}  // namespace pfgeom
