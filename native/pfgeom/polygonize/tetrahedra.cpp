#include "pfgeom/polygonize/tetrahedra.h"

#include "pfgeom/polygonize/lattice.h"

#include <algorithm>
#include <utility>

namespace pfgeom {
namespace {

std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
}

constexpr std::size_t kBitsOfSlot = 8;

// Of 64 · `words` bits.
std::size_t bit_of(std::uint64_t key, std::size_t words) {
    return hash_key(key) & (64 * words - 1);
}

}  // namespace

std::size_t TetEdgeTable::slot_of(std::uint64_t key) const {
    std::size_t slot = hash_key(key) & (slots_.size() - 1);
    while (slots_[slot].vertex >= 0 && slots_[slot].key != key) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
}

void TetEdgeTable::note(std::uint64_t key) {
    const std::size_t bit = bit_of(key, noted_.size());
    noted_[bit / 64] |= std::uint64_t{1} << bit % 64;
}

std::int32_t TetEdgeTable::find(std::int32_t a, std::int32_t b) const {
    if (slots_.empty()) return -1;
    const std::uint64_t key = edge_key(a, b);
    const std::size_t bit = bit_of(key, noted_.size());
    return (noted_[bit / 64] >> bit % 64 & 1) != 0 ? slots_[slot_of(key)].vertex : -1;
}

void TetEdgeTable::insert(std::int32_t a, std::int32_t b, std::int32_t vertex) {
    if (2 * (used_ + 1) > slots_.size()) {
        const std::vector<Entry> old = std::exchange(slots_, {});
        slots_.resize(std::max<std::size_t>(1024, 2 * old.size()));
        noted_.assign(slots_.size() * kBitsOfSlot / 64, 0);
        for (const Entry& e : old) {
            if (e.vertex < 0) continue;
            slots_[slot_of(e.key)] = e;
            note(e.key);
        }
    }
    const std::uint64_t key = edge_key(a, b);
    slots_[slot_of(key)] = {key, vertex};
    note(key);
    ++used_;
}

}  // namespace pfgeom
