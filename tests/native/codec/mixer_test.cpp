#include "pfgeom/codec/mixer.h"

#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <climits>
#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

TEST(Mixer, SquashIsTheLogisticFunction) {
    for (int x = -12 * kStretchOne; x <= 12 * kStretchOne; x += 4) {
        const double exact = 65536 / (1 + std::exp(-static_cast<double>(x) / kStretchOne));
        EXPECT_NEAR(squash(x), std::clamp(exact, 1.0, 65535.0), 1.1) << x;
    }
    EXPECT_EQ(squash(INT_MIN), squash(-11 * kStretchOne));
    EXPECT_EQ(squash(INT_MAX), squash(11 * kStretchOne));
}

TEST(Mixer, StretchIsItsInverse) {
    for (Probability p = 8; p < 65536; p += 16) {
        const double exact = std::log(p / (65536.0 - p)) * kStretchOne;
        EXPECT_NEAR(stretch(p), exact,
                    4 + kStretchOne * 0.6 * 65536.0 / (static_cast<double>(p) * (65536.0 - p)) * 16);
        if (p > 8) {
            EXPECT_GE(stretch(p), stretch(p - 16));
        }
    }
    EXPECT_EQ(stretch(0xFFFFFFFFU), stretch(65535));
}

// Both tables, as they are specified: a change of a single entry would make old files unreadable.
TEST(Mixer, TablesNeverChange) {
    std::uint64_t hash = 0;
    for (int x = -11 * kStretchOne; x <= 11 * kStretchOne; x += 4) hash = hash * 31 + squash(x);
    for (Probability p = 0; p < 65536; p += 16) hash = hash * 31 + static_cast<std::uint64_t>(stretch(p));
    EXPECT_EQ(hash, 13855788087749139892U);
}

TEST(Mixer, Log2Sixteenths) {
    EXPECT_EQ(log2_sixteenths(0), 0);
    EXPECT_EQ(log2_sixteenths(16), 16);
    EXPECT_EQ(log2_sixteenths(48), 32);
    for (std::uint32_t x = 0; x < 100000; x += 7) {
        EXPECT_NEAR(log2_sixteenths(x), 16 * std::log2(1 + x / 16.0), 1.0 + 0.09 * 16) << x;
        EXPECT_LE(log2_sixteenths(x), log2_sixteenths(x + 1));
    }
    EXPECT_EQ(log2_sixteenths(0xFFFFFFFFU), 28 * 16);
}

// What a bit is, and what it is predicted from.
struct Sample {
    int bit;
    ContextMixer::Where where;
    std::array<std::uint32_t, 3> contexts;
    std::array<int, 2> features;
};

std::vector<Sample> samples(std::uint64_t seed, int n) {
    Random random(seed);
    std::vector<Sample> list;
    for (int i = 0; i < n; ++i) {
        const auto state = static_cast<std::uint32_t>(random.below(64));
        Sample s;
        s.bit = random.below(80) < state ? 1 : 0;
        s.where = {static_cast<std::uint32_t>(random.below(3)), state % 5, state % 7};
        s.contexts = {state, state / 4, static_cast<std::uint32_t>(random.below(1U << 24))};
        s.features = {static_cast<int>(state * 100) - 3200, 500};
        list.push_back(s);
    }
    return list;
}

TEST(Mixer, BitsComeBack) {
    const auto list = samples(1, 50000);
    EntropyCoder writer;
    ContextMixer mixer;
    for (const Sample& s : list) EXPECT_EQ(mixer.code(writer, s.bit, s.where, s.contexts, s.features), s.bit);
    const auto bytes = writer.finish();
    EntropyCoder reader(bytes);
    ContextMixer same;
    for (const Sample& s : list) ASSERT_EQ(same.code(reader, 0, s.where, s.contexts, s.features), s.bit);
    EXPECT_TRUE(reader.ended_cleanly());
}

TEST(Mixer, LearnsWhatItsContextsTell) {
    Random random(2);
    EntropyCoder coder;
    ContextMixer mixer;
    double information = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
        const auto state = static_cast<std::uint32_t>(random.below(8));
        const double p = 0.02 + 0.12 * state;
        const std::array<std::uint32_t, 2> contexts{state, static_cast<std::uint32_t>(random.below(4))};
        mixer.code(coder, random.uniform() < p ? 1 : 0, {1, 0, 0}, contexts);
        information -= p * std::log2(p) + (1 - p) * std::log2(1 - p);
    }
    const double bits = 8.0 * static_cast<double>(coder.finish().size());
    EXPECT_LT(bits, information * 1.02);
    EXPECT_NEAR(mixer.spent_bits()[1], bits, 0.001 * bits);
}

TEST(Mixer, ARunOfEqualBitsCostsLittleMoreThanTheFloor) {
    EntropyCoder coder;
    ContextMixer mixer;
    const std::array<std::uint32_t, 2> contexts{0, 1};
    for (int i = 0; i < 1'000'000; ++i) mixer.code(coder, 0, {1, 0, 0}, contexts);
    EXPECT_LT(coder.finish().size(), 64U);  // the floor alone is 44
}

TEST(Mixer, IntegersComeBack) {
    std::vector<std::int32_t> values{0, 1, -1, 2, -2, INT_MAX, INT_MIN, INT_MAX - 1, INT_MIN + 1};
    Random random(3);
    for (int i = 0; i < 5000; ++i) {
        values.push_back(static_cast<std::int32_t>(random.next() >> 32) >> random.below(32));
    }
    EntropyCoder writer;
    ContextMixer mixer;
    for (const std::int32_t v : values) {
        EXPECT_EQ(mixer.code_int(writer, v, 10, 3), v);
        EXPECT_EQ(mixer.code_uint(writer, static_cast<std::uint32_t>(v), 12), static_cast<std::uint32_t>(v));
    }
    const auto bytes = writer.finish();
    EntropyCoder reader(bytes);
    ContextMixer same;
    for (const std::int32_t v : values) {
        ASSERT_EQ(same.code_int(reader, 0, 10, 3), v);
        ASSERT_EQ(same.code_uint(reader, 0, 12), static_cast<std::uint32_t>(v));
    }
    EXPECT_TRUE(reader.ended_cleanly());
}

// More contexts than are remembered: they share, and still both directions agree.
TEST(Mixer, MoreContextsThanItMayRememberStillComeBack) {
    const auto feed = [](EntropyCoder& coder, ContextMixer& mixer, bool check) {
        Random random(4);
        for (std::uint32_t i = 0; i < 100000; ++i) {
            const int bit = random.below(1000) == 0 ? 1 : 0;
            const std::array<std::uint32_t, 3> contexts{0, i, i ^ 0x5555U};
            const int out = mixer.code(coder, bit, {1, i % 4096, i / 8 % 4096}, contexts);
            if (check) {
                ASSERT_EQ(out, bit) << i;
            }
        }
    };
    EntropyCoder writer;
    ContextMixer mixer;
    feed(writer, mixer, false);
    const auto bytes = writer.finish();
    EXPECT_LT(bytes.size(), 3000U);
    EntropyCoder reader(bytes);
    ContextMixer same;
    feed(reader, same, true);
    EXPECT_TRUE(reader.ended_cleanly());
}

}  // namespace
}  // namespace pfgeom
