#include "pfgeom/polygonize/tetrahedra.h"

#include "pfgeom/polygonize/lattice.h"

#include <algorithm>
#include <utility>

namespace pfgeom {
namespace {

std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
}

}  // namespace

std::size_t TetEdgeTable::slot_of(std::uint64_t key) const {
    std::size_t slot = hash_key(key) & (slots_.size() - 1);
    while (slots_[slot].vertex >= 0 && slots_[slot].key != key) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
}

std::int32_t TetEdgeTable::find(std::int32_t a, std::int32_t b) const {
    return slots_.empty() ? -1 : slots_[slot_of(edge_key(a, b))].vertex;
}

void TetEdgeTable::insert(std::int32_t a, std::int32_t b, std::int32_t vertex) {
    if (2 * (used_ + 1) > slots_.size()) {
        const std::vector<Entry> old = std::exchange(slots_, {});
        slots_.resize(std::max<std::size_t>(1024, 2 * old.size()));
        for (const Entry& e : old)
            if (e.vertex >= 0) slots_[slot_of(e.key)] = e;
    }
    const std::uint64_t key = edge_key(a, b);
    slots_[slot_of(key)] = {key, vertex};
    ++used_;
}

void TetEdgeTable::clear() {
    slots_.clear();
    used_ = 0;
}

}  // namespace pfgeom
