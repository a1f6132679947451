#include "pfgeom/codec/promise_codec.h"

#include "pfgeom/base/error.h"
#include "pfgeom/codec/quantize.h"

#include <optional>

namespace pfgeom {
namespace {

// Bits of mantissas and offsets of exponents, so that codes are not negative.
constexpr int kLengthBits = 16, kLengthExponentBits = 8, kLengthExponent = 128;
constexpr int kErrorBits = 5, kErrorExponentBits = 6, kErrorExponent = 40;

enum class ToleranceForm : std::uint32_t { none, decimal_share, decimal_length, share };

// All of the head as integers.
struct Codes {
    bool certified = false, rms_metric = false, functions_certified = false;
    ShortFloat diagonal;
    ToleranceForm form = ToleranceForm::none;
    Decimal decimal;
    ShortFloat share;
    ShortFloat bound, rms, bound_functions;  // in tolerances; in diagonals if there is no tolerance
    friend bool operator==(const Codes&, const Codes&) = default;
};

// Errors too small for the exponent are raised to the least that it can hold.
ShortFloat error_above(double ratio) {
    const ShortFloat error = short_float_above(ratio, kErrorBits);
    constexpr ShortFloat kLeast{1 - kErrorExponent, 1U << kErrorBits};
    return error.mantissa != 0 && error.exponent < kLeast.exponent ? kLeast : error;
}

double unit_of_errors(double diagonal, const Promise& promise) {
    return promise.tolerance > 0 ? promise.tolerance : diagonal;
}

void quantise_tolerance(Codes& codes, double diagonal, double tolerance) {
    if (tolerance <= 0) return;
    if (const auto share = as_decimal(tolerance / diagonal)) {
        codes.form = ToleranceForm::decimal_share;
        codes.decimal = *share;
    } else if (const auto length = as_decimal(tolerance)) {
        codes.form = ToleranceForm::decimal_length;
        codes.decimal = *length;
    } else {
        codes.form = ToleranceForm::share;
        codes.share = short_float_above(tolerance / value_of(codes.diagonal, kLengthBits), kLengthBits);
    }
}

double tolerance_of(const Codes& codes, double diagonal) {
    switch (codes.form) {
        case ToleranceForm::decimal_share:
            return value_of(codes.decimal) * diagonal;
        case ToleranceForm::decimal_length:
            return value_of(codes.decimal);
        case ToleranceForm::share:
            return value_of(codes.share, kLengthBits) * diagonal;
        case ToleranceForm::none:
            break;
    }
    return 0;
}

// What codes cannot hold is refused at encoding.
void require_range(const Codes& codes) {
    const auto fits = [](const ShortFloat& x, int offset, int bits) {
        return x.mantissa == 0 || (x.exponent + offset >= 0 && x.exponent + offset < (1 << bits));
    };
    if (!fits(codes.diagonal, kLengthExponent, kLengthExponentBits)) {
        throw InvalidInput("the diagonal is not between 2^-128 and 2^128");
    }
    if (!fits(codes.share, kLengthExponent, kLengthExponentBits)) {
        throw InvalidInput("the tolerance is out of proportion to the diagonal");
    }
    if (!fits(codes.bound, kErrorExponent, kErrorExponentBits) ||
        !fits(codes.rms, kErrorExponent, kErrorExponentBits)) {
        throw InvalidInput("bound_mesh or rms is out of proportion to the tolerance");
    }
    if (!fits(codes.bound_functions, kErrorExponent, kErrorExponentBits)) {
        throw InvalidInput("bound_functions is out of proportion to the tolerance");
    }
}

// Errors are measured against the tolerance as a reader sees it.
Codes quantise(double diagonal, const Promise& promise) {
    Codes codes;
    codes.certified = promise.certified;
    codes.rms_metric = promise.metric == Metric::rms;
    codes.diagonal = short_float_above(diagonal, kLengthBits);
    quantise_tolerance(codes, diagonal, promise.tolerance);
    const double stored_diagonal = value_of(codes.diagonal, kLengthBits);
    Promise stored;
    stored.tolerance = tolerance_of(codes, stored_diagonal);
    const double unit = unit_of_errors(stored_diagonal, stored);
    codes.bound = error_above(promise.bound_mesh / unit);
    codes.rms = error_above(promise.rms / unit);
    codes.functions_certified = promise.functions_certified;
    codes.bound_functions = error_above(promise.bound_functions / unit);
    return codes;
}

void dequantise(const Codes& codes, double& diagonal, Promise& promise) {
    diagonal = value_of(codes.diagonal, kLengthBits);
    promise.certified = codes.certified;
    promise.metric = codes.rms_metric ? Metric::rms : Metric::max;
    promise.tolerance = tolerance_of(codes, diagonal);
    const double unit = unit_of_errors(diagonal, promise);
    promise.bound_mesh = value_of(codes.bound, kErrorBits) * unit;
    promise.rms = value_of(codes.rms, kErrorBits) * unit;
    promise.functions_certified = codes.functions_certified;
    promise.bound_functions = value_of(codes.bound_functions, kErrorBits) * unit;
}

bool code_bit(EntropyCoder& coder, bool value) {
    return coder.code_raw(value ? 1 : 0, 1) != 0;
}

void code_length(EntropyCoder& coder, ShortFloat& x) {
    x.mantissa = (1U << kLengthBits) | coder.code_raw(x.mantissa & ((1U << kLengthBits) - 1), kLengthBits);
    x.exponent = static_cast<int>(coder.code_raw(static_cast<std::uint32_t>(x.exponent + kLengthExponent),
                                                 kLengthExponentBits)) -
                 kLengthExponent;
}

// Exponent code 0: zero.
void code_error(EntropyCoder& coder, ShortFloat& x) {
    const int in = x.mantissa == 0 ? 0 : x.exponent + kErrorExponent;
    const int out = static_cast<int>(coder.code_raw(static_cast<std::uint32_t>(in), kErrorExponentBits));
    if (out == 0) {
        x = {};
        return;
    }
    x.exponent = out - kErrorExponent;
    x.mantissa = (1U << kErrorBits) | coder.code_raw(x.mantissa & ((1U << kErrorBits) - 1), kErrorBits);
}

// One bit where it is not known.
void code_bound_functions(CodecStream& stream, Codes& codes) {
    if (!code_bit(stream.coder, codes.bound_functions.mantissa != 0)) return;
    codes.functions_certified = code_bit(stream.coder, codes.functions_certified);
    code_error(stream.coder, codes.bound_functions);
    if (codes.bound_functions.mantissa == 0) stream.fail(FormatStatus::bad_header);
}

void code_tolerance(CodecStream& stream, Codes& codes) {
    codes.form = static_cast<ToleranceForm>(stream.coder.code_raw(static_cast<std::uint32_t>(codes.form), 2));
    if (codes.form == ToleranceForm::share) code_length(stream.coder, codes.share);
    if (codes.form != ToleranceForm::decimal_share && codes.form != ToleranceForm::decimal_length) return;
    const std::uint32_t digits = stream.mixer.code_uint(
        stream.coder, static_cast<std::uint32_t>(codes.decimal.digits), kToleranceKind);
    stream.expect(digits >= 1 && digits <= Decimal::kMaxDigits);
    codes.decimal.digits = static_cast<int>(digits % (Decimal::kMaxDigits + 1));
    const auto exponent = static_cast<std::uint32_t>(codes.decimal.exponent - Decimal::kMinExponent);
    codes.decimal.exponent = static_cast<int>(stream.coder.code_raw(exponent, 5)) + Decimal::kMinExponent;
}

}  // namespace

void code_promise(CodecStream& stream, double& diagonal, Promise& promise) {
    Codes codes;
    if (!stream.decoding()) {
        codes = quantise(diagonal, promise);
        require_range(codes);
    }
    codes.certified = code_bit(stream.coder, codes.certified);
    codes.rms_metric = code_bit(stream.coder, codes.rms_metric);
    code_length(stream.coder, codes.diagonal);
    code_tolerance(stream, codes);
    code_error(stream.coder, codes.bound);
    code_error(stream.coder, codes.rms);
    code_bound_functions(stream, codes);
    dequantise(codes, diagonal, promise);
    if (stream.decoding() && stream.ok() && quantise(diagonal, promise) != codes)
        stream.fail(FormatStatus::bad_header);
}

}  // namespace pfgeom
