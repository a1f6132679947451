#include "pfgeom/codec/codec_stream.h"

#include "pfgeom/codec/quantize.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pfgeom {

CodecStream::CodecStream(std::span<const std::uint8_t> bytes, int format_version)
    : version(format_version),
      coder(bytes),
      derive(DeriveBudget::of_bytes(bytes.size())),
      memory(bytes.size() * kMemoryPerByte) {}

bool CodecStream::charge(std::size_t count, std::size_t each) {
    if (count > memory / each) {
        fail(FormatStatus::limit_exceeded);
        return false;
    }
    memory -= count * each;
    return true;
}

bool code_flag(CodecStream& stream, bool value, std::uint32_t kind, std::uint32_t context) {
    const std::array<std::uint32_t, 1> contexts{context};
    return stream.mixer.code(stream.coder, value ? 1 : 0, {kind, 0, 0}, contexts) != 0;
}

std::int64_t code_wide(CodecStream& stream, std::int64_t value, std::uint32_t context) {
    const std::uint64_t in =
        value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    const std::uint32_t width = stream.mixer.code_uint(
        stream.coder, static_cast<std::uint32_t>(std::bit_width(in)), kWideKind, context);
    if (width > 63) stream.fail(FormatStatus::bad_value);
    if (width == 0 || width > 63) return 0;
    const bool negative = stream.coder.code_raw(value < 0 ? 1 : 0, 1) != 0;
    const int high = std::max(0, static_cast<int>(width) - 33), low = static_cast<int>(width) - 1 - high;
    std::uint64_t magnitude =
        (std::uint64_t{1} << high) |
        stream.coder.code_raw(static_cast<std::uint32_t>(in >> low) & ((std::uint32_t{1} << high) - 1), high);
    magnitude = (magnitude << low) | stream.coder.code_raw(static_cast<std::uint32_t>(in), low);
    return negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
}

namespace {

void code_scaled(CodecStream& stream, Scaled& scaled, std::span<double> values, std::uint32_t context) {
    scaled.integers.resize(values.size());
    scaled.exponent = stream.mixer.code_int(stream.coder, scaled.exponent, kExponentKind, context);
    stream.expect(std::abs(std::int64_t{scaled.exponent}) <= 1100);
    for (std::size_t i = 0; i < values.size() && stream.ok(); ++i) {
        scaled.integers[i] =
            code_wide(stream, scaled.integers[i], context * 16 + static_cast<std::uint32_t>(i));
        values[i] = std::ldexp(static_cast<double>(scaled.integers[i]), scaled.exponent);
    }
}

void code_binary64(CodecStream& stream, double& value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const std::uint64_t high = stream.coder.code_raw(static_cast<std::uint32_t>(bits >> 32), 32);
    value = std::bit_cast<double>(high << 32 | stream.coder.code_raw(static_cast<std::uint32_t>(bits), 32));
}

}  // namespace

void code_numbers(CodecStream& stream, std::span<double> values, std::uint32_t context) {
    std::optional<Scaled> scaled;
    if (!stream.decoding()) {
        for (double& v : values) v += 0.0;  // no negative zero
        scaled = as_scaled(values);
    }
    if (code_flag(stream, scaled.has_value(), kScaledFlag, context)) {
        if (!scaled) scaled.emplace();
        code_scaled(stream, *scaled, values, context);
    } else {
        for (double& v : values) code_binary64(stream, v);
    }
    if (!stream.decoding() || !stream.ok()) return;
    // One list of numbers, one form.
    for (const double v : values) stream.expect(std::isfinite(v) && !(v == 0 && std::signbit(v)));
    if (stream.ok()) stream.expect(as_scaled(values) == scaled);
}

}  // namespace pfgeom
