#include "pfgeom/polygonize/plain_leaf.h"

#include "pfgeom/polygonize/lattice.h"

#include <utility>

namespace pfgeom {
namespace {

class Maker {
  public:
    constexpr explicit Maker(unsigned inside) : inside_(inside) {}

    constexpr PlainLeaf run() {
        for (int axis = 0; axis < 3; ++axis) {
            face(0, axis);
            face(bit(axis), axis);
        }
        number_sheets();
        return leaf_;
    }

  private:
    static constexpr unsigned bit(int axis) { return 1U << static_cast<unsigned>(axis); }

    // Its sides in the order of SheetFinder::face; their crossings are joined in pairs.
    constexpr void face(unsigned low, int axis) {
        const int u = next_axis(axis), v = last_axis(axis);
        std::array<std::uint8_t, 4> met{};
        std::size_t n = 0;
        for (const auto& [from, along] :
             {std::pair{low, u}, std::pair{low | bit(u), v}, std::pair{low | bit(v), u}, std::pair{low, v}})
            if (crossed(from, along)) met[n++] = crossing(from, along);
        if (n == 2) unite(met[0], met[1]);
        leaf_.ambiguous |= n == 4;
    }

    constexpr bool crossed(unsigned low, int axis) const {
        return ((inside_ >> low ^ inside_ >> (low | bit(axis))) & 1U) != 0;
    }

    constexpr std::uint8_t crossing(unsigned low, int axis) {
        for (std::uint8_t i = 0; i < leaf_.crossings; ++i)
            if (leaf_.crossing[i].low == low && leaf_.crossing[i].axis == axis) return i;
        const bool high_u = (low & bit(next_axis(axis))) != 0, high_v = (low & bit(last_axis(axis))) != 0;
        leaf_.crossing[leaf_.crossings] = {
            .low = static_cast<std::uint8_t>(low),
            .high = static_cast<std::uint8_t>(low | bit(axis)),
            .axis = static_cast<std::uint8_t>(axis),
            .quadrant = static_cast<std::uint8_t>(high_u ? (high_v ? 0 : 3) : (high_v ? 1 : 2)),
            .sheet = leaf_.crossings};
        return leaf_.crossings++;
    }

    // As in SheetFinder: the first crossing of a sheet is its root, and gets its number.
    constexpr std::uint8_t root(std::uint8_t i) const {
        while (leaf_.crossing[i].sheet != i) i = leaf_.crossing[i].sheet;
        return i;
    }
    constexpr void unite(std::uint8_t a, std::uint8_t b) {
        a = root(a);
        b = root(b);
        leaf_.crossing[a > b ? a : b].sheet = a > b ? b : a;
    }
    constexpr void number_sheets() {
        for (std::uint8_t i = 0; i < leaf_.crossings; ++i) {
            PlainCrossing& c = leaf_.crossing[i];
            c.sheet = c.sheet == i ? leaf_.sheets++ : leaf_.crossing[c.sheet].sheet;
        }
    }

    unsigned inside_;
    PlainLeaf leaf_;
};

constexpr auto kPlainLeaves = [] {
    std::array<PlainLeaf, 256> table{};
    for (unsigned i = 0; i < 256; ++i) table[i] = Maker(i).run();
    return table;
}();

}  // namespace

const PlainLeaf& plain_leaf(std::uint8_t inside) {
    return kPlainLeaves[inside];
}

}  // namespace pfgeom
