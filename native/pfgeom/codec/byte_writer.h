// Bytes in the order in which ByteReader reads them.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

class ByteWriter {
  public:
    void byte(std::uint8_t value) { bytes_.push_back(value); }
    void append(std::span<const std::uint8_t> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    void varint(std::uint64_t value) {
        for (; value >= 0x80U; value >>= 7) byte(static_cast<std::uint8_t>(0x80U | (value & 0x7FU)));
        byte(static_cast<std::uint8_t>(value));
    }
    void u32(std::uint32_t value) {
        for (int shift = 0; shift < 32; shift += 8) byte(static_cast<std::uint8_t>(value >> shift));
    }
    void f64(double value) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        u32(static_cast<std::uint32_t>(bits));
        u32(static_cast<std::uint32_t>(bits >> 32));
    }
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }
    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace pfgeom
