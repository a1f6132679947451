#include "pfgeom/codec/mixer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pfgeom {
namespace {

constexpr int kStretchMax = 11 * kStretchOne;  // squash is within a floor of 0 or 1 beyond

// exp by its series and squaring: +, *, / only, so that the tables are the same on every machine.
double reproducible_exp(double x) {
    const double y = x / 256;
    double sum = 1, term = 1;
    for (int i = 1; i < 12; ++i) {
        term = term * y / i;
        sum += term;
    }
    for (int i = 0; i < 8; ++i) sum *= sum;
    return sum;
}

struct Tables {
    // squash at steps of 4/kStretchOne, and stretch at p = (i + 1/2) / 4096.
    std::array<std::uint16_t, 2 * kStretchMax / 4 + 1> squash{};
    std::array<std::int16_t, 4096> stretch{};

    Tables() {
        for (std::size_t i = 0; i < squash.size(); ++i) {
            const double x = (static_cast<double>(i) * 4 - kStretchMax) / kStretchOne;
            const double p = 65536.0 / (1 + reproducible_exp(-x));
            squash[i] = static_cast<std::uint16_t>(std::clamp(p + 0.5, 1.0, 65535.0));
        }
        int at = -kStretchMax;  // the inverse, by walking up the table above
        for (std::size_t i = 0; i < stretch.size(); ++i) {
            const int p = static_cast<int>(i) * 16 + 8;
            while (at < kStretchMax && squash[static_cast<std::size_t>(at + kStretchMax) / 4] < p) at += 4;
            stretch[i] = static_cast<std::int16_t>(at);
        }
    }
};

const Tables& tables() {
    static const Tables kTables;
    return kTables;
}

// Learning of a slot: the step is 1/(count + 1.5), not below 1/kSlowest (of 100-1000 tried, 250 is best on
// coefficients of igea and armadillo at rms 2e-4, within 0.2 %).
constexpr std::uint32_t kSlowest = 250;
// Trust in a slot that has seen `count` bits: count / (count + 0.4).
constexpr int confidence(std::uint32_t count) {
    const std::uint32_t n = std::min(count, 255U);
    return static_cast<int>(n * 2560 / (n * 10 + 4));  // of 256
}

}  // namespace

int stretch(Probability p) {
    return tables().stretch[std::min(p, 65535U) >> 4];
}

Probability squash(int stretched) {
    const int x = std::clamp(stretched, -kStretchMax, kStretchMax);
    return tables().squash[static_cast<std::size_t>(x + kStretchMax) / 4];
}

int log2_sixteenths(std::uint32_t x) {
    const std::uint32_t v = std::min(x, 0xFFFFFFFFU - 16) + 16;
    const int e = static_cast<int>(std::bit_width(v)) - 1;  // v in [2^e, 2^(e+1))
    const std::uint32_t mantissa = static_cast<std::uint32_t>((std::uint64_t{v} << 4 >> e) - 16);
    return (e - 4) * 16 + static_cast<int>(mantissa);
}

ContextMixer::Weights& ContextMixer::weights(std::uint64_t key, std::size_t contexts, std::size_t inputs) {
    Weights& set = weight_sets_[key];
    if (set.w.empty()) {
        set.w.assign(inputs, 0);
        std::fill_n(set.w.begin(), contexts, 65536 / 5);
    }
    return set;
}

void ContextMixer::learn(Weights& set, std::span<const int> inputs, int dot, int bit) {
    // w += rate * (bit - p) * input, rate = 0.005 + 0.15 / (count + 10)
    const std::int64_t error = (bit != 0 ? 65536 : 0) - static_cast<std::int64_t>(squash(dot));
    const std::int64_t rate = 328 + 9830 / (static_cast<std::int64_t>(set.count) + 10);  // of 65536
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const std::int64_t step = error * rate * inputs[i] / (std::int64_t{65536} * kStretchOne);
        set.w[i] = static_cast<std::int32_t>(std::clamp<std::int64_t>(set.w[i] + step, -(1 << 22), 1 << 22));
    }
    ++set.count;
}

int ContextMixer::code(EntropyCoder& coder, int bit, const Where& where, std::span<const std::uint32_t> contexts,
                       std::span<const int> features) {
    const std::size_t n = contexts.size() + features.size();
    active_.resize(contexts.size());
    inputs_.resize(n);
    for (std::size_t i = 0; i < contexts.size(); ++i) {
        const std::uint64_t key = (std::uint64_t{where.kind} << 40) | (std::uint64_t{i} << 32) | contexts[i];
        Slot& slot = slots_[key];
        active_[i] = &slot;
        inputs_[i] = stretch(slot.p >> 16) * confidence(slot.count) / 256;
    }
    std::copy(features.begin(), features.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(contexts.size()));

    const std::array<std::uint64_t, 2> keys{(std::uint64_t{where.kind} << 32) | where.weight_set_a,
                                            (std::uint64_t{where.kind} << 32) | (1U << 16) | where.weight_set_b};
    std::array<Weights*, 2> sets{};
    std::array<int, 2> dots{};
    for (std::size_t s = 0; s < 2; ++s) {
        sets[s] = &weights(keys[s], contexts.size(), n);
        std::int64_t sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += std::int64_t{sets[s]->w[i]} * inputs_[i];
        dots[s] = static_cast<int>(std::clamp<std::int64_t>(sum / 65536, -kStretchMax, kStretchMax));
    }
    const Probability p = squash((dots[0] + dots[1]) / 2);
    bit = coder.code(bit, p);

    if (spent_.size() <= where.kind) spent_.resize(where.kind + 1);
    const double q = static_cast<double>(std::clamp(p, EntropyCoder::kFloor, 65536 - EntropyCoder::kFloor)) / 65536;
    spent_[where.kind] -= std::log2(bit != 0 ? q : 1 - q);
    for (std::size_t s = 0; s < 2; ++s) learn(*sets[s], inputs_, dots[s], bit);
    for (Slot* slot : active_) {
        const std::uint32_t target = bit != 0 ? 0xFFFFFFFFU : 0U;
        const std::uint32_t divisor = std::min(2 * slot->count + 3, 2 * kSlowest);  // twice count + 1.5
        const std::int64_t step = (std::int64_t{target} - slot->p) * 2 / divisor;
        slot->p = static_cast<std::uint32_t>(std::int64_t{slot->p} + step);
        ++slot->count;
    }
    return bit;
}

std::uint32_t ContextMixer::code_uint(EntropyCoder& coder, std::uint32_t value, std::uint32_t kind,
                                      std::uint32_t context) {
    const std::uint64_t v = std::uint64_t{value} + 1;  // Exp-Golomb: exponent, then mantissa
    const int bits = static_cast<int>(std::bit_width(v)) - 1;
    int e = 0;
    for (; e < 31; ++e) {
        const std::array<std::uint32_t, 2> ctx{static_cast<std::uint32_t>(e), context * 32 + static_cast<std::uint32_t>(e)};
        if (code(coder, bits > e ? 1 : 0, {kind, 0, 0}, ctx) == 0) break;
    }
    std::uint64_t result = 1;
    for (int i = e - 1; i >= 0; --i) {
        const int in = static_cast<int>((v >> i) & 1U);
        const bool top = i >= e - 3;  // lower bits are as good as random
        const std::array<std::uint32_t, 1> ctx{static_cast<std::uint32_t>(e) * 16 + static_cast<std::uint32_t>(top ? (result & 15U) + 1 : 0)};
        const int out = top ? code(coder, in, {kind + 1, 0, 0}, ctx) : coder.code(in, 32768);
        result = (result << 1) | static_cast<std::uint64_t>(out);
    }
    return static_cast<std::uint32_t>(result - 1);
}

std::int32_t ContextMixer::code_int(EntropyCoder& coder, std::int32_t value, std::uint32_t kind,
                                    std::uint32_t context) {
    const auto folded = value >= 0 ? static_cast<std::uint32_t>(value) * 2
                                   : static_cast<std::uint32_t>(-(value + 1)) * 2 + 1;
    const std::uint32_t u = code_uint(coder, folded, kind, context);
    return (u & 1U) != 0 ? -static_cast<std::int32_t>(u / 2) - 1 : static_cast<std::int32_t>(u / 2);
}

}  // namespace pfgeom
