#include "pfgeom/polygonize/samples.h"

namespace pfgeom {

std::size_t Samples::slot_of(const LatticePoint& p) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_key(point_key(p)) & mask;
    while (slots_[slot] >= 0 && list_[static_cast<std::size_t>(slots_[slot])].point != p)
        slot = (slot + 1) & mask;
    return slot;
}

void Samples::grow() {
    slots_.assign(slots_.empty() ? 1024 : slots_.size() * 2, -1);
    for (std::size_t i = 0; i < list_.size(); ++i)
        slots_[slot_of(list_[i].point)] = static_cast<std::int32_t>(i);
}

std::int32_t Samples::find_or_add(const LatticePoint& p) {
    if (2 * list_.size() >= slots_.size()) grow();
    const std::size_t slot = slot_of(p);
    if (slots_[slot] < 0) {
        slots_[slot] = static_cast<std::int32_t>(list_.size());
        list_.push_back({.point = p});
    }
    return slots_[slot];
}

const Sample* Samples::find(const LatticePoint& p) const {
    if (slots_.empty()) return nullptr;
    const std::int32_t i = slots_[slot_of(p)];
    return i < 0 ? nullptr : &list_[static_cast<std::size_t>(i)];
}

}  // namespace pfgeom
