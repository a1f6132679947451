// Numbers as integers of known size: what a file stores is a set of codes, and a decoded value must give back
// the codes that it came from, so that one model has one file. Exact operations (frexp, ldexp, floor) only.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pfgeom {

/// mantissa · 2^(exponent - bits), mantissa in [2^bits, 2^(bits+1)), or zero if mantissa = 0.
struct ShortFloat {
    int exponent = 0;
    std::uint32_t mantissa = 0;
    friend bool operator==(const ShortFloat&, const ShortFloat&) = default;
};
/// Rounded up, but that what exceeds a short float by less than one part in 2^44 counts as equal to it.
/// x >= 0, finite.
ShortFloat short_float_above(double x, int bits);
double value_of(const ShortFloat& x, int bits);

/// digits · 10^exponent, 1 <= digits <= kMaxDigits: how people write tolerances.
struct Decimal {
    static constexpr int kMaxDigits = 999, kMinExponent = -15, kMaxExponent = 16;
    int digits = 0, exponent = 0;
    friend bool operator==(const Decimal&, const Decimal&) = default;
};
/// With as few digits as possible; empty if x is not such a number within one part in 10^12. x > 0, finite.
std::optional<Decimal> as_decimal(double x);
double value_of(const Decimal& x);

/// Doubles as integers with a common exponent: values[i] = integers[i] · 2^exponent, the exponent as large as
/// possible (0 if all are zero).
struct Scaled {
    int exponent = 0;
    std::vector<std::int64_t> integers;
    friend bool operator==(const Scaled&, const Scaled&) = default;
};
/// Empty if an integer would need more than 62 bits. Finite values.
std::optional<Scaled> as_scaled(std::span<const double> values);

}  // namespace pfgeom
