#include "pfgeom/codec/entropy.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr std::uint32_t kTop = 1U << 24;  // the range is kept at or above this

}  // namespace

EntropyCoder::EntropyCoder(std::span<const std::uint8_t> bytes) : decoding_(true), bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = (code_ << 8) | next_byte();
}

std::uint8_t EntropyCoder::next_byte() {
    const std::size_t at = position_++;
    return at < bytes_.size() ? bytes_[at] : std::uint8_t{0};
}

// Moves the top byte of low_ out. It is held back while a later carry could still change it.
void EntropyCoder::shift_low() {
    const auto carry = static_cast<std::uint8_t>(low_ >> 32);
    if (carry != 0 || low_ < 0xFF000000U || pending_ == 0) {
        if (pending_ > 0) {
            output_.push_back(static_cast<std::uint8_t>(cache_ + carry));
            output_.insert(output_.end(), pending_ - 1, static_cast<std::uint8_t>(0xFF + carry));
        }
        cache_ = static_cast<std::uint8_t>(low_ >> 24);
        pending_ = 0;
    }
    ++pending_;
    low_ = (low_ & 0x00FFFFFFU) << 8;
}

int EntropyCoder::code(int bit, Probability p1) {
    const Probability p = std::clamp(p1, kFloor, 65536 - kFloor);
    const std::uint32_t bound = (range_ >> 16) * p;
    if (decoding_) bit = code_ < bound ? 1 : 0;
    if (bit != 0) {
        range_ = bound;
    } else {
        range_ -= bound;
        if (decoding_) code_ -= bound;
        else low_ += bound;
    }
    while (range_ < kTop) {
        range_ <<= 8;
        if (decoding_) code_ = (code_ << 8) | next_byte();
        else shift_low();
    }
    return bit;
}

std::uint32_t EntropyCoder::code_raw(std::uint32_t value, int count) {
    std::uint32_t result = 0;
    for (int i = count - 1; i >= 0; --i) {
        result = (result << 1) | static_cast<std::uint32_t>(code(static_cast<int>((value >> i) & 1U), 32768));
    }
    return result;
}

std::vector<std::uint8_t> EntropyCoder::finish() {
    // The value in [low, low + range) with the most trailing zero bits: its zero bytes need not be written.
    for (int k = 32; k >= 0; k -= 8) {
        const std::uint64_t mask = (std::uint64_t{1} << k) - 1;
        const std::uint64_t value = (low_ + mask) & ~mask;
        if (value - low_ < range_) {
            low_ = value;
            break;
        }
    }
    for (int i = 0; i < 5; ++i) shift_low();
    // A decoder looks 4 bytes ahead, so at most 4 may go without looking like a truncated stream.
    for (int i = 0; i < 4 && !output_.empty() && output_.back() == 0; ++i) output_.pop_back();
    return std::move(output_);
}

}  // namespace pfgeom
