// Values of either byte order from a span of bytes, never past its end.
#pragma once

#include "pfgeom/base/error.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace pfgeom {

static_assert(std::endian::native == std::endian::little,
              "the order of bytes is written out for such machines");

class BinaryScanner {
  public:
    BinaryScanner(std::span<const std::uint8_t> bytes, bool big_endian)
        : bytes_(bytes), big_endian_(big_endian) {}

    std::size_t bytes_left() const { return bytes_.size() - at_; }

    template <class T>
    T get() {
        std::uint8_t raw[sizeof(T)];
        std::memcpy(raw, take(sizeof(T)), sizeof(T));
        if (big_endian_) std::reverse(raw, raw + sizeof(T));
        T value;
        std::memcpy(&value, raw, sizeof(T));
        return value;
    }
    void skip(std::size_t n) { take(n); }

  private:
    const std::uint8_t* take(std::size_t n) {
        if (n > bytes_left())
            throw InvalidInput("byte " + std::to_string(at_) + ": the file ends before its content does");
        at_ += n;
        return bytes_.data() + (at_ - n);
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool big_endian_;
};

}  // namespace pfgeom
