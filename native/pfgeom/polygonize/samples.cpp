#include "pfgeom/polygonize/samples.h"

#include <bit>

namespace pfgeom {
namespace {

struct Place {
    std::uint64_t group = 0;
    std::size_t within = 0;
};

// On the coarsest grid that has the point, whose spacing goes into the group's name as a bit that is zero in
// all corners of such groups.
Place place_of(const LatticePoint& p) {
    const int level = std::countr_zero(static_cast<std::uint32_t>(p[0] | p[1] | p[2]) | 1U << kDeepest);
    const std::int32_t size = 2 << level;
    const LatticePoint corner{(p[0] & -size) | size / 2, p[1] & -size, p[2] & -size};
    return {point_key(corner), static_cast<std::size_t>((p[0] >> level & 1) | (p[1] >> level & 1) << 1 |
                                                        (p[2] >> level & 1) << 2)};
}

}  // namespace

std::int32_t Samples::find_or_add(const LatticePoint& p) {
    const Place place = place_of(p);
    std::int32_t& group = groups_[place.group];
    if (group < 0) {
        group = static_cast<std::int32_t>(index_.size());
        index_.emplace_back().fill(-1);
    }
    std::int32_t& row = index_[static_cast<std::size_t>(group)][place.within];
    if (row < 0) {
        row = static_cast<std::int32_t>(list_.size());
        list_.push_back({.point = p});
    }
    return row;
}

const Sample* Samples::find(const LatticePoint& p) const {
    const Place place = place_of(p);
    const std::int32_t group = groups_.find(place.group);
    if (group < 0) return nullptr;
    const std::int32_t row = index_[static_cast<std::size_t>(group)][place.within];
    return row < 0 ? nullptr : &list_[static_cast<std::size_t>(row)];
}

}  // namespace pfgeom
