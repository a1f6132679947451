#include "pfgeom/codec/entropy.h"

#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

struct Coded {
    int bit;
    Probability p;
};

// Bits that follow their probabilities, which range over all that code() takes.
std::vector<Coded> likely_bits(std::uint64_t seed, int n) {
    Random random(seed);
    std::vector<Coded> list;
    for (int i = 0; i < n; ++i) {
        const auto p = static_cast<Probability>(random.below(65537));
        list.push_back({random.below(65536) < p ? 1 : 0, p});
    }
    return list;
}

std::vector<std::uint8_t> encode_all(const std::vector<Coded>& list) {
    EntropyCoder coder;
    for (const Coded& c : list) coder.code(c.bit, c.p);
    return coder.finish();
}

void expect_decodes(const std::vector<Coded>& list, const std::vector<std::uint8_t>& bytes) {
    EntropyCoder coder(bytes);
    for (const Coded& c : list) ASSERT_EQ(coder.code(-1, c.p), c.bit);
    EXPECT_TRUE(coder.ended_cleanly());
    EXPECT_FALSE(coder.exhausted());
}

TEST(Entropy, BitsComeBack) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const auto list = likely_bits(seed, static_cast<int>(seed % 300));
        expect_decodes(list, encode_all(list));
    }
    const auto many = likely_bits(1, 200000);
    expect_decodes(many, encode_all(many));
}

TEST(Entropy, UnlikelyBitsComeBack) {
    for (const Probability p : {0U, 1U, 65535U, 65536U}) {
        for (int bit = 0; bit < 2; ++bit) {
            const std::vector<Coded> list(1000, {bit, p});
            expect_decodes(list, encode_all(list));
        }
    }
}

// A run of 0xFF that a carry then turns into zeros: the interval is halved upwards many times, then left
// below.
TEST(Entropy, CarriesRunThroughManyBytes) {
    for (int ones = 0; ones < 400; ++ones) {
        std::vector<Coded> list(static_cast<std::size_t>(ones), {0, 1U << 15});
        list.push_back({0, 65000});
        list.push_back({1, 300});
        list.push_back({0, 300});
        expect_decodes(list, encode_all(list));
    }
}

TEST(Entropy, CostIsTheInformationOfTheBits) {
    const auto list = likely_bits(3, 200000);
    double bits = 0;
    for (const Coded& c : list) {
        const double p = std::clamp(c.p, EntropyCoder::kFloor, 65536 - EntropyCoder::kFloor) / 65536.0;
        bits -= std::log2(c.bit != 0 ? p : 1 - p);
    }
    const auto bytes = encode_all(list);
    EXPECT_NEAR(static_cast<double>(bytes.size()), bits / 8, 5);
    EntropyCoder coder;
    for (const Coded& c : list) coder.code(c.bit, c.p);
    EXPECT_NEAR(coder.bits_so_far(), bits, 40);
}

// The promise behind every count check: no bit is cheaper than 1/2840 of a bit.
TEST(Entropy, NoBitIsCheaperThanTheFloor) {
    for (const int bit : {0, 1}) {
        const std::size_t n = 10'000'000;
        EntropyCoder coder;
        for (std::size_t i = 0; i < n; ++i) coder.code(bit, bit != 0 ? 65536 : 0);
        const auto bytes = coder.finish().size();
        EXPECT_GE(bytes * 8, n / 2850);
        EXPECT_LE(bytes * 8, n / 2830 + 32);
    }
}

TEST(Entropy, BytesSoFarAgreeAtEveryBit) {
    const auto list = likely_bits(5, 5000);
    const auto bytes = encode_all(list);
    EntropyCoder writer, reader(bytes);
    for (const Coded& c : list) {
        writer.code(c.bit, c.p);
        reader.code(0, c.p);
        ASSERT_EQ(writer.bytes_so_far(), reader.bytes_so_far());
    }
}

TEST(Entropy, RawBitsComeBack) {
    Random random(7);
    std::vector<std::pair<std::uint32_t, int>> list;
    for (int i = 0; i < 2000; ++i) {
        const int n = static_cast<int>(random.below(33));
        const auto value = static_cast<std::uint32_t>(random.next());
        list.emplace_back(n == 32 ? value : value & ((1U << n) - 1), n);
    }
    EntropyCoder writer;
    for (const auto& [value, n] : list) EXPECT_EQ(writer.code_raw(value, n), value);
    const auto bytes = writer.finish();
    EntropyCoder reader(bytes);
    for (const auto& [value, n] : list) ASSERT_EQ(reader.code_raw(0, n), value);
    EXPECT_TRUE(reader.ended_cleanly());
}

TEST(Entropy, NothingCostsNothing) {
    EntropyCoder writer;
    EXPECT_TRUE(writer.finish().empty());
    EXPECT_TRUE(EntropyCoder(std::span<const std::uint8_t>()).ended_cleanly());
}

// Another tail would decode to the same bits: it must be refused, or one model had several files.
TEST(Entropy, OnlyTheShortestTailEndsCleanly) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const auto list = likely_bits(seed, 40);
        const auto bytes = encode_all(list);
        const auto ends_cleanly = [&list](const std::vector<std::uint8_t>& other) {
            EntropyCoder coder(other);
            bool same = true;
            for (const Coded& c : list) same = coder.code(0, c.p) == c.bit && same;
            return same && coder.ended_cleanly();
        };
        for (int extra = 1; extra < 6; ++extra) {
            std::vector<std::uint8_t> longer = bytes;
            longer.insert(longer.end(), static_cast<std::size_t>(extra), 0);
            EXPECT_FALSE(ends_cleanly(longer));
        }
        for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
            std::vector<std::uint8_t> flipped = bytes;
            flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
            EXPECT_FALSE(ends_cleanly(flipped)) << "seed " << seed << " bit " << bit;
        }
    }
}

// The one beginning that no encoder writes: the value would lie above the whole range.
TEST(Entropy, AStreamAboveTheRangeNeverEndsCleanly) {
    for (std::size_t n = 4; n < 40; ++n) {
        const std::vector<std::uint8_t> bytes(n, 0xFF);
        EntropyCoder coder(bytes);
        while (!coder.exhausted()) {
            coder.code(0, 40000);
            ASSERT_FALSE(coder.ended_cleanly());
        }
    }
}

TEST(Entropy, ReadingOnAfterTheEndIsSeen) {
    const auto bytes = encode_all(likely_bits(9, 100));
    EntropyCoder coder(bytes);
    int bits = 0;
    while (!coder.exhausted() && bits < 100000) {
        coder.code(0, 32768);
        ++bits;
    }
    EXPECT_LT(bits, static_cast<int>(bytes.size() + 5) * 8);
    EXPECT_FALSE(coder.ended_cleanly());
}

}  // namespace
}  // namespace pfgeom
