// Little-endian values into a growing list of bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace pfgeom {

static_assert(std::endian::native == std::endian::little,
              "the order of bytes is written out for such machines");

class ValueWriter {
  public:
    explicit ValueWriter(std::size_t expected) { bytes_.reserve(expected); }

    template <class T>
    void put(T value) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof(T));
        std::memcpy(bytes_.data() + at, &value, sizeof(T));
    }
    void put_text(std::string_view text) { bytes_.insert(bytes_.end(), text.begin(), text.end()); }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace pfgeom
