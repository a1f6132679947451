// Named outcomes of reading bytes from outside.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace pfgeom {

enum class FormatStatus : std::uint8_t {
    ok,
    not_a_pfg,           ///< the magic is missing
    text_damage,         ///< the magic was changed as by a text-mode transfer
    unknown_version,     ///< a major version that this reader does not know
    truncated,           ///< the file ends before its content does
    trailing_bytes,      ///< the file goes on after its content
    checksum_mismatch,   ///< a CRC-32C does not fit
    unknown_section,     ///< a required section that this reader does not know
    bad_section,         ///< section table: order, overlap, duplicate, or a reserved bit
    bad_header,          ///< frame, promise or counts outside their ranges
    limit_exceeded,      ///< a count is larger than the bytes left can hold, or than a cap of Limits
    bad_value,           ///< a decoded value outside its range
    bad_stream,          ///< the entropy coder did not end in its known state
    derivation_mismatch  ///< the derived geometry differs from the encoder's (16-bit check)
};

std::string_view describe(FormatStatus status);  ///< one plain sentence
std::string_view name(FormatStatus status);      ///< the enumerator, as text

/// A value, or the status that says why there is none.
template <class T>
class Result {
  public:
    Result(T value) : value_(std::move(value)) {}
    Result(FormatStatus status) : status_(status) {}
    explicit operator bool() const { return value_.has_value(); }
    FormatStatus status() const { return status_; }
    T& operator*() { return *value_; }
    const T& operator*() const { return *value_; }
    T* operator->() { return &*value_; }
    const T* operator->() const { return &*value_; }

  private:
    std::optional<T> value_;
    FormatStatus status_ = FormatStatus::ok;
};

}  // namespace pfgeom
