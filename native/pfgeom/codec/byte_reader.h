// Bytes from outside, read in order. The first read beyond the end makes all later ones fail too.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pfgeom {

class ByteReader {
  public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::size_t left() const { return bytes_.size() - position_; }
    std::size_t position() const { return position_; }
    bool ok() const { return ok_; }

    std::uint8_t byte() {
        const auto one = take(1);
        return one.empty() ? std::uint8_t{0} : one[0];
    }
    std::span<const std::uint8_t> take(std::size_t n) {
        if (!ok_ || n > left()) {
            ok_ = false;
            return {};
        }
        position_ += n;
        return bytes_.subspan(position_ - n, n);
    }
    /// Seven bits a byte, the lowest first; the shortest form only.
    std::uint64_t varint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 63; shift += 7) {
            const std::uint8_t b = byte();
            value |= std::uint64_t{b & 0x7FU} << shift;
            if ((b & 0x80U) == 0) {
                ok_ = ok_ && (b != 0 || shift == 0);
                return ok_ ? value : 0;
            }
        }
        ok_ = false;
        return 0;
    }
    std::uint32_t u32() {
        std::uint32_t value = 0;
        for (int shift = 0; shift < 32; shift += 8) value |= std::uint32_t{byte()} << shift;
        return value;
    }
    double f64() {
        const std::uint64_t low = u32();
        return std::bit_cast<double>(low | std::uint64_t{u32()} << 32);
    }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t position_ = 0;
    bool ok_ = true;
};

}  // namespace pfgeom
