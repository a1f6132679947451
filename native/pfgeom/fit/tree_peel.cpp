#include "pfgeom/fit/tree_peel.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace pfgeom {
namespace {

constexpr std::size_t kCounted = 4096;  // members that are counted; all are looked at for purity

using Bits = std::vector<std::uint64_t>;

// Quadrics with a member of each label on each side.
struct Sides {
    std::array<Bits, 2> high, low;  // by label

    Sides(const SampleTable& samples, std::span<const std::int32_t> members) {
        for (std::size_t label = 0; label < 2; ++label) {
            high[label].assign(samples.words(), 0);
            low[label].assign(samples.words(), 0);
        }
        for (const std::int32_t m : members) {
            const auto i = static_cast<std::size_t>(m);
            const std::size_t label = samples[i].inside ? 1 : 0;
            const std::uint64_t* signs = samples.signs(i);
            for (std::size_t w = 0; w < samples.words(); ++w) {
                high[label][w] |= signs[w];
                low[label][w] |= ~signs[w];
            }
        }
    }
};

bool has(const Bits& bits, std::size_t q) {
    return (bits[q / 64] >> (q % 64) & 1U) != 0;
}

// A side of a quadric with one label only.
struct PureSide {
    std::size_t quadric;
    bool high, inside;
    std::size_t count = 0, own = 0, own_missed = 0;  // members there; of its patch and label; and not there
};

std::vector<PureSide> pure_sides(const Sides& sides, const std::vector<char>& asked) {
    std::vector<PureSide> pure;
    for (std::size_t q = 0; q < asked.size(); ++q) {
        if (asked[q] != 0) continue;
        for (const bool high : {true, false}) {
            const auto& side = high ? sides.high : sides.low;
            const bool outside = has(side[0], q), inside = has(side[1], q);
            if (inside != outside) pure.push_back({q, high, inside});
        }
    }
    return pure;
}

}  // namespace

std::int32_t peeled_quadric(const SampleTable& samples, std::span<const std::int32_t> members,
                            const std::vector<char>& asked) {
    std::vector<PureSide> pure = pure_sides(Sides(samples, members), asked);
    const std::size_t stride = (members.size() + kCounted - 1) / kCounted;
    for (std::size_t k = 0; k < members.size(); k += stride) {
        const auto i = static_cast<std::size_t>(members[k]);
        const TreeSample& sample = samples[i];
        for (PureSide& side : pure) {
            if (sample.inside != side.inside) continue;
            const bool there = samples.positive(i, side.quadric) == side.high;
            const bool own = sample.patch == static_cast<std::int32_t>(side.quadric);
            side.count += there;
            side.own += there && own;
            side.own_missed += !there && own;
        }
    }
    std::erase_if(pure, [](const PureSide& s) { return s.own <= s.own_missed; });
    const auto best = std::ranges::max_element(pure, {}, &PureSide::count);
    return best == pure.end() ? -1 : static_cast<std::int32_t>(best->quadric);
}

}  // namespace pfgeom
