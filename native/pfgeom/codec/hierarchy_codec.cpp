// Source of the contexts: measurements in docs/HIERARCHY.md. Everything here is integer arithmetic on values
// that eval/surroundings.h derives; the same code writes and reads.
#include "pfgeom/codec/hierarchy_codec.h"

#include "pfgeom/eval/surroundings.h"

#include <algorithm>
#include <array>
#include <bit>

namespace pfgeom {
namespace {

// Kinds of the mixer. 0..15: "the magnitude has more than k bits".
constexpr std::uint32_t kMantissa = 20, kSign = 21, kThin = 30, kHead = 40;
constexpr int kMostBits = 16;  // of a magnitude

int bits_of(std::int32_t v) {
    return static_cast<int>(std::bit_width(static_cast<std::uint32_t>(std::abs(v))));
}

// Logarithmic bin of a magnitude in sixteenths: min(n - 1, floor(num / den · log2(1 + 8 a))).
std::uint32_t bin(std::int32_t sixteenths, int num, int den, int n) {
    const int l = log2_sixteenths(static_cast<std::uint32_t>(sixteenths) * 8);
    return static_cast<std::uint32_t>(std::min(n - 1, l * num / (16 * den)));
}

// Seven bins of a signed value in sixteenths, times num / den: beyond ±2, ±0.7, ±0.15, about zero.
std::uint32_t signed_bin(std::int32_t v, int num, int den) {
    const std::int64_t t = std::int64_t{v} * num / den;
    return t < -32 ? 0 : t < -11 ? 1 : t < -2 ? 2 : t <= 2 ? 3 : t <= 11 ? 4 : t <= 32 ? 5 : 6;
}

// x / (1 + |x|) of a value in sixteenths, as a feature.
int soft_sign(std::int32_t v) {
    return static_cast<int>(std::int64_t{kStretchOne} * v / (16 + std::abs(v)));
}

// 0.3 · log2(x + 1 / 2^offset) of a magnitude in sixteenths, as a feature.
int log_feature(std::int32_t v, int offset) {
    const int l = log2_sixteenths(static_cast<std::uint32_t>(v) << offset);
    return (l - 16 * offset) * 3 * kStretchOne / 160;
}

std::uint32_t three_way(std::int32_t z) {
    return z > 0 ? 2 : z < 0 ? 0 : 1;
}

// One coefficient's prediction from its neighbours and the levels before.
struct Outlook {
    std::int32_t near = 0;               // weighted mean |z| of the earlier neighbours
    std::int32_t near_sum = 0;           // the same with signs
    std::int32_t first = 0, second = 0;  // z of the two nearest
    std::uint32_t count = 0;
};

Outlook outlook(const Surroundings& s, const std::vector<std::int32_t>& z, std::size_t i) {
    Outlook o;
    std::int64_t magnitude = 0, sum = 0, weight = 0;
    for (const Neighbour& n : s.of(i)) {
        const std::int32_t v = z[static_cast<std::size_t>(n.index)];
        magnitude += std::int64_t{n.weight} * std::abs(v);
        sum += std::int64_t{n.weight} * v;
        weight += n.weight;
        if (o.count == 0) o.first = v;
        if (o.count == 1) o.second = v;
        ++o.count;
    }
    if (weight > 0) {
        o.near = static_cast<std::int32_t>(16 * magnitude / weight);
        o.near_sum = static_cast<std::int32_t>(16 * sum / weight);
    } else {
        o.near = s.parent[i] / 4;
    }
    return o;
}

class LevelCoder {
  public:
    LevelCoder(EntropyCoder& coder, ContextMixer& mixer, const Surroundings& surroundings, Level& level)
        : coder_(coder), mixer_(mixer), s_(surroundings), level_(level) {}

    /// Leaves off where the budget of balls is exceeded.
    void run(DeriveBudget& budget) {
        level_.z.resize(level_.centres.size());
        for (std::size_t i = 0; i < level_.z.size() && !coder_.exhausted() && !budget.exceeded(); ++i) {
            code(i);
            if (level_.z[i] != 0) --budget.balls;
        }
    }

  private:
    std::uint32_t mixed(std::uint32_t x, std::uint32_t y, std::uint32_t q) const {
        return ((x * 32 + y) * 32 + q) * 2 + lattice_;
    }

    void code(std::size_t i) {
        const Outlook o = outlook(s_, level_.z, i);
        lattice_ = level_.lattice[i];
        const std::int32_t z = level_.z[i];
        const int bits = code_bits(i, o, bits_of(z));
        if (bits == 0) {
            level_.z[i] = 0;
            return;
        }
        const std::int32_t magnitude = code_mantissa(o, i, bits, std::abs(z));
        const bool positive = code_sign(i, o, bits, z > 0);
        level_.z[i] = positive ? magnitude : -magnitude;
    }

    // A guess of the magnitude, in sixteenths: weights by regression on igea and armadillo.
    std::int32_t guess(std::size_t i, const Outlook& o) const {
        const std::int64_t m = std::int64_t{45} * o.near + std::int64_t{15} * s_.parent[i] +
                               std::int64_t{3} * s_.grandparent[i] + std::int64_t{5} * std::abs(s_.bend[i]);
        return static_cast<std::int32_t>(m / 100);
    }

    std::uint32_t value_bin(std::size_t i) const {
        if (lattice_ == 0) return 0;
        return 1 + static_cast<std::uint32_t>(std::clamp((s_.value[i] * 2 + 72) / 16, 0, 8));
    }

    int code_bits(std::size_t i, const Outlook& o, int bits) {
        const auto depth = static_cast<std::uint32_t>(level_.depth);
        const std::int32_t parent = s_.parent[i], grandparent = s_.grandparent[i],
                           bend = std::abs(s_.bend[i]);
        const std::uint32_t qa = bin(o.near, 2, 1, 14), qb = bin(parent, 6, 5, 9),
                            qg = bin(grandparent, 1, 1, 8), qc = bin(bend, 6, 5, 9),
                            qm = bin(guess(i, o), 3, 1, 26);
        const auto e1 = static_cast<std::uint32_t>(std::min(4, bits_of(o.first))),
                   e2 = static_cast<std::uint32_t>(std::min(4, bits_of(o.second)));
        const std::array<std::uint32_t, 8> contexts{mixed(depth, 0, 0),
                                                    mixed(qa, 0, 1),
                                                    mixed(qa / 2, qb, 2),
                                                    mixed(qb, qg, 3),
                                                    mixed(e1, e2 * 3 + std::min(2U, qb / 2), 4),
                                                    mixed(qa / 3, qc, 5),
                                                    mixed(qm, 0, 6),
                                                    mixed(value_bin(i), std::min(o.count, 6U), 7 + e1)};
        const std::array<int, 5> features{410, log_feature(o.near, 4), log_feature(parent, 3),
                                          log_feature(grandparent, 3), log_feature(bend, 3)};
        int k = 0;
        while (k < kMostBits) {
            const ContextMixer::Where where{static_cast<std::uint32_t>(k), depth, qm / 3};
            if (mixer_.code(coder_, bits > k ? 1 : 0, where, contexts, features) == 0) break;
            ++k;
        }
        return k;
    }

    std::int32_t code_mantissa(const Outlook& o, std::size_t i, int bits, std::int32_t magnitude) {
        const auto k = static_cast<std::uint32_t>(bits);
        const std::uint32_t qm = bin(guess(i, o), 3, 1, 26);
        std::uint32_t value = 1;
        for (int t = bits - 2; t >= 0; --t) {
            const int in = (magnitude >> t) & 1;
            const auto place = static_cast<std::uint32_t>(bits - t);
            int out = 0;
            if (place > 3) {
                out = coder_.code(in, 32768);
            } else {
                const std::array<std::uint32_t, 3> contexts{value * 64 + k, k * 64 + place,
                                                            (k * 64 + place) * 32 + qm};
                out = mixer_.code(coder_, in, {kMantissa, 0, 0}, contexts);
            }
            value = value * 2 + static_cast<std::uint32_t>(out);
        }
        return static_cast<std::int32_t>(value);
    }

    bool code_sign(std::size_t i, const Outlook& o, int bits, bool positive) {
        const auto depth = static_cast<std::uint32_t>(level_.depth);
        const std::int32_t sum = o.near_sum, parent = s_.parent_sum[i], grandparent = s_.grandparent_sum[i],
                           bend = s_.bend[i];
        const auto size = static_cast<std::uint32_t>(std::min(bits, 3));
        const std::array<std::uint32_t, 7> contexts{
            mixed(depth, 0, 0),
            mixed(signed_bin(sum, 1, 1), signed_bin(parent, 1, 2), 1),
            mixed(signed_bin(parent, 1, 2), signed_bin(grandparent, 1, 3), 2),
            mixed(three_way(o.first), three_way(o.second), 3),
            mixed(signed_bin(bend, 1, 3), signed_bin(parent, 1, 2), 4),
            mixed(signed_bin(sum, 2, 1), size, 5),
            mixed(value_bin(i), signed_bin(sum, 1, 1), 6)};
        const int value =
            lattice_ == 0 ? 0
                          : std::clamp(s_.value[i] * (kStretchOne / 16), -8 * kStretchOne, 8 * kStretchOne);
        const std::array<int, 6> features{soft_sign(sum),         soft_sign(2 * sum), soft_sign(parent),
                                          soft_sign(grandparent), soft_sign(bend),    value};
        return mixer_.code(coder_, positive ? 1 : 0, {kSign, depth, size}, contexts, features) != 0;
    }

    EntropyCoder& coder_;
    ContextMixer& mixer_;
    const Surroundings& s_;
    Level& level_;
    std::uint32_t lattice_ = 0;
};

// Flags of the thin cells, predicted from the flags around and from the field.
void code_thin(EntropyCoder& coder, ContextMixer& mixer, const std::vector<ProbedCell>& cells, Level& level) {
    const auto depth = static_cast<std::uint32_t>(level.depth);
    const int any = coder.code(level.thin.empty() ? 0 : 1, 32768);
    if (any == 0) {
        level.thin.clear();
        return;
    }
    const double size = std::ldexp(2.0, 1 - level.depth);
    level.thin.resize(cells.size());
    CellTable on;
    const auto flag = [&on](const CellIndex& c, int x, int y, int z) -> std::uint32_t {
        return on.find(CellIndex{c.x + x, c.y + y, c.z + z}.key()) > 0 ? 1 : 0;
    };
    for (std::size_t i = 0; i < cells.size() && !coder.exhausted(); ++i) {
        const CellIndex& c = cells[i].index;
        const Jet& jet = cells[i].jet;
        const double length = norm(jet.gradient);
        const auto distance =
            static_cast<std::uint32_t>(std::min(7.0, 4 * std::abs(jet.value) / std::max(0.3, length) / size));
        const auto slope = static_cast<std::uint32_t>(std::min(7.0, 4 * length));
        std::uint32_t around = 0;
        for (int t = 0; t < 27; ++t) around += flag(c, t / 9 - 1, t / 3 % 3 - 1, t % 3 - 1);
        const std::uint32_t face = flag(c, -1, 0, 0) + flag(c, 0, -1, 0) + flag(c, 0, 0, -1);
        const std::array<std::uint32_t, 4> contexts{face, std::min(around, 6U) * 8 + distance,
                                                    face * 8 + slope, (jet.value > 0 ? 8U : 0U) + distance};
        const int bit = mixer.code(coder, level.thin[i], {kThin, depth, 0}, contexts);
        level.thin[i] = static_cast<std::uint8_t>(bit);
        if (bit != 0) on[c.key()] = 1;
    }
}

bool code_head(EntropyCoder& coder, ContextMixer& mixer, HierarchyHead& head) {
    for (std::uint8_t& a : head.axes) a = static_cast<std::uint8_t>(mixer.code_uint(coder, a, kHead) & 255U);
    head.step_code = static_cast<std::uint8_t>(coder.code_raw(head.step_code, 8));
    head.ratio_code = static_cast<std::uint8_t>(mixer.code_int(coder, head.ratio_code - 74, kHead + 2) + 74);
    head.shrink_code = static_cast<std::uint8_t>(coder.code_raw(head.shrink_code, 3));
    head.first_sheet =
        static_cast<std::uint8_t>(kFirstLevel + coder.code_raw(head.first_sheet - kFirstLevel, 2));
    return head.axes[0] > 0 && head.axes[1] > 0 && head.axes[2] > 0 && head.ratio_code >= 16;
}

}  // namespace

FormatStatus code_hierarchy(EntropyCoder& coder, ContextMixer& mixer, Function& function,
                            DeriveBudget& budget, const Task& task) {
    const bool decoding = coder.decoding();
    if (!code_head(coder, mixer, function.head)) return FormatStatus::bad_value;
    if (decoding) {
        function.base = base_of(function.head);
        function.levels.clear();
    }
    FunctionField field(function.base);
    std::uint32_t check = 0;
    for (int depth = kFirstLevel; depth <= kLastLevel; ++depth) {
        const auto at = static_cast<std::size_t>(depth - kFirstLevel);
        const bool more = coder.code(at < function.levels.size() ? 1 : 0, 58982) != 0;  // 9 times of 10
        if (!more) break;
        if (decoding) function.levels.push_back(empty_level(function.head, depth));
        Level& level = function.levels[at];
        std::vector<ProbedCell> cells;
        if (depth >= function.head.first_sheet && depth <= kLastThinLevel) {
            if (decoding || !level.thin.empty()) cells = thin_candidates(field, depth, budget, task);
            code_thin(coder, mixer, cells, level);
        }
        if (decoding) place_centres(field, function.head, cells, level, budget, task);
        if (budget.exceeded() || coder.exhausted()) {
            return coder.exhausted() ? FormatStatus::truncated : FormatStatus::limit_exceeded;
        }
        const Surroundings surroundings = survey(field, level, task);
        LevelCoder(coder, mixer, surroundings, level).run(budget);
        if (budget.exceeded()) return FormatStatus::limit_exceeded;
        check = fingerprint(level, check);
        field.add(level);
    }
    const std::uint32_t stored = coder.code_raw(check & 0xFFFFU, 16);
    if (coder.exhausted()) return FormatStatus::truncated;
    return stored == (check & 0xFFFFU) ? FormatStatus::ok : FormatStatus::derivation_mismatch;
}

}  // namespace pfgeom
