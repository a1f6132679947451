// Text with numbers in their shortest form that reads back to the same double, the same in every locale.
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace pfgeom {

class TextWriter {
  public:
    TextWriter& operator<<(std::string_view text) {
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        return *this;
    }
    TextWriter& operator<<(double value) { return put_number(value); }
    TextWriter& operator<<(std::int64_t value) { return put_number(value); }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    template <class Number>
    TextWriter& put_number(Number value) {
        char buffer[32];  // 24 for any double, 20 for any 64-bit integer
        const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
        return *this << std::string_view(buffer, static_cast<std::size_t>(result.ptr - buffer));
    }

    std::vector<std::uint8_t> bytes_;
};

}  // namespace pfgeom
