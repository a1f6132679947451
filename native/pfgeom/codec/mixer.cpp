#include "pfgeom/codec/mixer.h"

#include "pfgeom/base/reproducible.h"

#include <algorithm>
#include <array>
#include <bit>

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

// Learning of a slot: the step is 1/(count + 1.5), not below 1/kSlowest (of 100-1000 tried, 250 is best on
// coefficients of igea and armadillo at rms 2e-4, within 0.2 %).
constexpr std::uint32_t kSlowest = 250;
// From here on the learning rate of weights has reached its end.
constexpr std::uint32_t kManyBits = 9830;

struct Tables {
    // squash at steps of 4/kStretchOne; stretch and the cost of a one in bits at p = (i + 1/2) / 4096.
    std::array<std::uint16_t, 2 * kStretchMax / 4 + 1> squash{};
    std::array<std::int16_t, 4096> stretch{};
    std::array<double, 4096> cost{};
    // By the bits that a slot has seen: step of learning, of 65536, and trust in it, n / (n + 0.4) of 256.
    std::array<std::int32_t, kSlowest + 1> step{}, confidence{};

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
            cost[i] = 12 - reproducible_log2(static_cast<double>(i) + 0.5);  // statistics only
        }
        for (int n = 0; n <= static_cast<int>(kSlowest); ++n) {
            step[static_cast<std::size_t>(n)] = 131072 / std::min(2 * n + 3, 2 * static_cast<int>(kSlowest));
            confidence[static_cast<std::size_t>(n)] = n * 2560 / (n * 10 + 4);
        }
    }
};

const Tables& tables() {
    static const Tables kTables;
    return kTables;
}

// What the mixer may remember after so many bytes of stream: a small file cannot make a reader allocate much.
// A slot takes up to 64 bytes (a table two thirds empty that is being copied), a weight set up to 400,
// together at most 6 KiB a byte. Real streams need 5-25 slots a byte.
constexpr std::size_t slots_allowed(std::size_t bytes) {
    return 4096 + 64 * bytes;
}
constexpr std::size_t sets_allowed(std::size_t bytes) {
    return 512 + 4 * bytes;
}
// A key beyond what is allowed shares one entry with all others of its kind and place.
constexpr std::uint64_t kShared = std::uint64_t{1} << 62;

}  // namespace

int stretch(Probability p) {
    return tables().stretch[std::min(p, 65535U) >> 4];
}

Probability squash(int stretched) {
    const int x = std::clamp(stretched, -kStretchMax, kStretchMax);
    return tables().squash[static_cast<std::size_t>(x + kStretchMax) / 4];
}

int log2_sixteenths(std::uint32_t x) {
    const std::uint64_t v = std::uint64_t{x} + 16;
    const int e = static_cast<int>(std::bit_width(v)) - 1;  // v in [2^e, 2^(e+1))
    return (e - 4) * 16 + static_cast<int>((v << 4 >> e) - 16);
}

ContextMixer::Slot& ContextMixer::slot(std::uint64_t key, std::size_t allowed) {
    if (Slot* known = slots_.find(key)) return *known;
    return slots_[slots_.size() < allowed ? key : kShared | (key >> 32)];
}

ContextMixer::WeightSet& ContextMixer::weight_set(std::uint64_t key, std::size_t allowed,
                                                  std::size_t contexts, std::size_t inputs) {
    if (WeightSet* known = sets_.find(key)) return *known;
    WeightSet& set = sets_[sets_.size() < allowed ? key : kShared | (key >> 16)];
    if (!set.made) {
        set = {static_cast<std::uint32_t>(weights_.size()), 0, true};
        weights_.resize(weights_.size() + contexts, 65536 / 5);
        weights_.resize(weights_.size() + inputs - contexts, 0);
    }
    return set;
}

int ContextMixer::dot(const WeightSet& set, std::span<const int> inputs) const {
    std::int64_t sum = 0;
    const std::int32_t* w = weights_.data() + set.first;
    for (std::size_t i = 0; i < inputs.size(); ++i) sum += std::int64_t{w[i]} * inputs[i];
    return static_cast<int>(std::clamp<std::int64_t>(sum / 65536, -kStretchMax, kStretchMax));
}

void ContextMixer::learn(WeightSet& set, std::span<const int> inputs, int dot, int bit) {
    // w += rate * (bit - p) * input, rate = 0.005 + 0.15 / (count + 10)
    const std::int64_t error = (bit != 0 ? 65536 : 0) - static_cast<std::int64_t>(squash(dot));
    const std::int64_t rate = 328 + 9830 / (static_cast<std::int64_t>(set.count) + 10);  // of 65536
    std::int32_t* w = weights_.data() + set.first;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const std::int64_t step = error * rate * inputs[i] / (std::int64_t{65536} * kStretchOne);
        w[i] = static_cast<std::int32_t>(std::clamp<std::int64_t>(w[i] + step, -(1 << 22), 1 << 22));
    }
    if (set.count < kManyBits) ++set.count;
}

int ContextMixer::code(EntropyCoder& coder, int bit, const Where& where,
                       std::span<const std::uint32_t> contexts, std::span<const int> features) {
    const Tables& table = tables();
    std::array<Slot*, kMostContexts> slots;
    std::array<int, kMostInputs> all;
    const std::span<int> inputs(all.data(), contexts.size() + features.size());
    const std::size_t bytes = coder.bytes_so_far(), may_have = slots_allowed(bytes);
    slots_.reserve_extra(contexts.size());
    for (std::size_t i = 0; i < contexts.size(); ++i) {
        slots[i] =
            &slot((std::uint64_t{where.kind} << 40) | (std::uint64_t{i} << 32) | contexts[i], may_have);
        all[i] = table.stretch[slots[i]->p >> 20] * table.confidence[slots[i]->count] / 256;
    }
    std::copy(features.begin(), features.end(),
              inputs.begin() + static_cast<std::ptrdiff_t>(contexts.size()));

    sets_.reserve_extra(2);
    const std::uint64_t key = std::uint64_t{where.kind} << 17;
    WeightSet& a = weight_set(key | where.weight_set_a, sets_allowed(bytes), contexts.size(), inputs.size());
    WeightSet& b =
        weight_set(key | 1U << 16 | where.weight_set_b, sets_allowed(bytes), contexts.size(), inputs.size());
    const int dot_a = dot(a, inputs), dot_b = dot(b, inputs);
    const Probability p = squash((dot_a + dot_b) / 2);
    bit = coder.code(bit, p);

    if (spent_.size() <= where.kind) spent_.resize(where.kind + 1);
    const Probability q =
        std::clamp(bit != 0 ? p : 65536 - p, EntropyCoder::kFloor, 65536 - EntropyCoder::kFloor);
    spent_[where.kind] += table.cost[q >> 4];
    learn(a, inputs, dot_a, bit);
    learn(b, inputs, dot_b, bit);
    for (Slot* s : std::span(slots.data(), contexts.size())) {
        const std::int64_t missing = (bit != 0 ? std::int64_t{0xFFFFFFFF} : 0) - s->p;
        s->p = static_cast<std::uint32_t>(s->p + ((missing * table.step[s->count]) >> 16));
        if (s->count < kSlowest) ++s->count;
    }
    return bit;
}

std::uint32_t ContextMixer::code_uint(EntropyCoder& coder, std::uint32_t value, std::uint32_t kind,
                                      std::uint32_t context) {
    // Exp-Golomb of value + 1: the exponent in unary, then the mantissa.
    const std::uint64_t v = std::uint64_t{value} + 1;
    const int exponent = static_cast<int>(std::bit_width(v)) - 1;
    int e = 0;
    for (; e < 32; ++e) {
        const auto place = static_cast<std::uint32_t>(e);
        const std::array<std::uint32_t, 2> contexts{place, context * 32 + place};
        if (code(coder, exponent > e ? 1 : 0, {kind, 0, 0}, contexts) == 0) break;
    }
    if (e == 32) return 0xFFFFFFFFU;  // the only value there
    std::uint32_t result = 1;
    for (int i = e - 1; i >= 0; --i) {
        const int in = static_cast<int>((v >> i) & 1U);
        const bool top = i >= e - 3;  // lower bits are as good as random
        const std::array<std::uint32_t, 1> contexts{static_cast<std::uint32_t>(e) * 16 + (result & 15U)};
        const int out = top ? code(coder, in, {kind + 1, 0, 0}, contexts) : coder.code(in, 32768);
        result = (result << 1) | static_cast<std::uint32_t>(out);
    }
    return result - 1;
}

std::int32_t ContextMixer::code_int(EntropyCoder& coder, std::int32_t value, std::uint32_t kind,
                                    std::uint32_t context) {
    // 0, -1, 1, -2, 2 ... become 0, 1, 2, 3, 4 ...
    const std::uint32_t folded = (static_cast<std::uint32_t>(value) << 1) ^ (value < 0 ? 0xFFFFFFFFU : 0U);
    const std::uint32_t u = code_uint(coder, folded, kind, context);
    return static_cast<std::int32_t>((u >> 1) ^ ((u & 1U) != 0 ? 0xFFFFFFFFU : 0U));
}

}  // namespace pfgeom
