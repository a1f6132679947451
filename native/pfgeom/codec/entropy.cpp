#include "pfgeom/codec/entropy.h"

#include "pfgeom/base/reproducible.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr std::uint32_t kTop = 1U << 24;  // the range is kept at or above this

}  // namespace

EntropyCoder::EntropyCoder(std::span<const std::uint8_t> bytes) : decoding_(true), bytes_(bytes) {
    while (position_ < kLookAhead) code_ = (code_ << 8) | byte_at(position_++);
    impossible_ = code_ == range_;
    if (impossible_) --code_;
}

// Moves the top byte of low_ out. It is held back while a later carry could still change it. (No carry can
// leave the first byte: low + range starts below 2^32 and never grows.)
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
    const auto bound = static_cast<std::uint32_t>((std::uint64_t{range_} * p) >> 16);
    if (decoding_) bit = code_ < bound ? 1 : 0;
    if (bit != 0) {
        range_ = bound;
    } else {
        range_ -= bound;
        if (decoding_)
            code_ -= bound;
        else
            low_ += bound;
    }
    while (range_ < kTop) {
        range_ <<= 8;
        if (decoding_)
            code_ = (code_ << 8) | byte_at(position_++);
        else
            shift_low();
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

// From low to the value in [low, low + range) that ends in the most zero bytes (the lowest of those).
std::uint32_t EntropyCoder::distance_to_tail(std::uint32_t low, std::uint32_t range) {
    for (const std::uint32_t mask : {0xFFFFFFFFU, 0x00FFFFFFU, 0x0000FFFFU, 0x000000FFU}) {
        const std::uint32_t distance = (0U - low) & mask;
        if (distance < range) return distance;
    }
    return 0;
}

std::vector<std::uint8_t> EntropyCoder::finish() {
    low_ += distance_to_tail(static_cast<std::uint32_t>(low_), range_);
    for (int i = 0; i < 5; ++i) shift_low();
    // A decoder looks 4 bytes ahead, so as many may go without looking like a truncated stream.
    for (std::size_t i = 0; i < kLookAhead && !output_.empty() && output_.back() == 0; ++i)
        output_.pop_back();
    return std::move(output_);
}

bool EntropyCoder::ended_cleanly() const {
    if (impossible_ || exhausted() || position_ < bytes_.size()) return false;
    // finish() stops leaving out zero bytes only at a byte that is not zero, or after four.
    const bool shortest = position_ == bytes_.size() + kLookAhead || bytes_.back() != 0;
    std::uint32_t value = 0;  // the last 32 bits of the stream's value: the encoder's low_ plus code_
    for (std::size_t i = kLookAhead; i > 0; --i) value = (value << 8) | byte_at(position_ - i);
    return shortest && code_ == distance_to_tail(value - code_, range_);
}

double EntropyCoder::bits_so_far() const {
    return 8.0 * static_cast<double>(bytes_so_far()) + 32 - reproducible_log2(static_cast<double>(range_));
}

}  // namespace pfgeom
