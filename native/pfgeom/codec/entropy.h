// The one entropy coder of .pfg files: an adaptive binary range coder that runs in either direction, so that
// the same function writes and reads a stream and the two cannot drift apart. Integers only.
// Source: Martin, "Range encoding", 1979; carry handling as in Subbotin's and Pavlov's coders (a cached byte
// and a run of 0xFF), departures: 16-bit probabilities and the shortest possible tail.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// Probability of a one, in 1/65536.
using Probability = std::uint32_t;

class EntropyCoder {
  public:
    /// No bit costs less than about 1/2840 of a bit: p is clamped to [kFloor, 65536 - kFloor]. This bounds what a
    /// byte can expand to (8 * 2840 symbols) and so lets counts be checked against the bytes that are left.
    static constexpr Probability kFloor = 16;

    EntropyCoder() = default;                                           ///< an encoder
    explicit EntropyCoder(std::span<const std::uint8_t> bytes);         ///< a decoder

    bool decoding() const { return decoding_; }

    /// Codes one bit. The encoder returns `bit`, the decoder ignores it and returns what was written.
    int code(int bit, Probability p1);

    /// `count` (<= 32) bits at one bit each, the highest first.
    std::uint32_t code_raw(std::uint32_t value, int count);

    /// Encoder: ends the stream and returns it, without trailing zero bytes.
    std::vector<std::uint8_t> finish();

    /// Decoder: true once more bytes were needed than there are (beyond the coder's own look-ahead). What was
    /// decoded since is meaningless; loops whose length was decoded must poll this.
    bool exhausted() const { return position_ > bytes_.size() + 4; }
    /// Decoder: true when exactly the given bytes were used.
    bool ended_cleanly() const { return position_ >= bytes_.size() && !exhausted(); }
    /// Bits that the stream has cost up to now, for statistics only (encoder and decoder).
    std::size_t bytes_so_far() const { return decoding_ ? position_ : output_.size() + pending_; }

  private:
    std::uint8_t next_byte();
    void shift_low();

    bool decoding_ = false;
    std::uint32_t range_ = 0xFFFFFFFFU;
    std::uint64_t low_ = 0;       // encoder
    std::uint8_t cache_ = 0;      // encoder: the byte that a carry may still change
    std::uint64_t pending_ = 0;   // encoder: the cache and the 0xFF bytes after it
    std::vector<std::uint8_t> output_;
    std::uint32_t code_ = 0;      // decoder
    std::size_t position_ = 0;    // decoder
    std::span<const std::uint8_t> bytes_;
};

}  // namespace pfgeom
