// The one entropy coder of .pfg files: an adaptive binary range coder that runs in either direction, so that
// the same function writes and reads a stream and the two cannot drift apart. Integers only.
// Source: Martin, "Range encoding", 1979; carry handling as in Subbotin's and Pavlov's coders (a cached byte
// and a run of 0xFF). Departures: 16-bit probabilities, a product that loses nothing to truncation, and the
// shortest possible tail, which the decoder checks: one sequence of bits has one stream.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// Probability of a one, in 1/65536.
using Probability = std::uint32_t;

class EntropyCoder {
  public:
    /// No bit costs less than about 1/2840 of a bit: p is clamped to [kFloor, 65536 - kFloor]. This bounds
    /// what a byte can expand to (8 * 2840 symbols) and so lets counts be checked against the bytes that are
    /// left.
    static constexpr Probability kFloor = 16;

    EntropyCoder() = default;                                    ///< an encoder
    explicit EntropyCoder(std::span<const std::uint8_t> bytes);  ///< a decoder; `bytes` must outlive it

    bool decoding() const { return decoding_; }

    /// Codes one bit. The encoder returns `bit`, the decoder ignores it and returns what was written.
    int code(int bit, Probability p1);

    /// `count` (<= 32) bits at one bit each, the highest first.
    std::uint32_t code_raw(std::uint32_t value, int count);

    /// Encoder: ends the stream and returns it. Up to four trailing zero bytes are left out.
    std::vector<std::uint8_t> finish();

    /// Decoder: true once more bytes were needed than there are (beyond the coder's own look-ahead). What was
    /// decoded since is meaningless; loops whose length was decoded must poll this.
    bool exhausted() const { return position_ > bytes_.size() + kLookAhead; }
    /// Decoder: true when the given bytes are exactly those that finish() returns for the bits decoded so
    /// far.
    bool ended_cleanly() const;

    /// Bytes that the stream has cost up to now: the same number in encoder and decoder at the same bit.
    std::size_t bytes_so_far() const {
        return decoding_ ? position_ - kLookAhead : output_.size() + pending_;
    }
    /// The same to a fraction of a bit, for statistics only.
    double bits_so_far() const;

  private:
    static constexpr std::size_t kLookAhead = 4;

    std::uint8_t byte_at(std::size_t position) const {
        return position < bytes_.size() ? bytes_[position] : std::uint8_t{0};
    }
    void shift_low();
    static std::uint32_t distance_to_tail(std::uint32_t low, std::uint32_t range);

    bool decoding_ = false;
    std::uint32_t range_ = 0xFFFFFFFFU;
    std::uint64_t low_ = 0;    // encoder
    std::uint8_t cache_ = 0;   // encoder: the byte that a carry may still change
    std::size_t pending_ = 0;  // encoder: the cache and the 0xFF bytes after it
    std::vector<std::uint8_t> output_;
    std::uint32_t code_ = 0;    // decoder: the stream's value above the encoder's low_, below range_
    bool impossible_ = false;   // decoder: the stream begins as no encoder's does
    std::size_t position_ = 0;  // decoder
    std::span<const std::uint8_t> bytes_;
};

}  // namespace pfgeom
