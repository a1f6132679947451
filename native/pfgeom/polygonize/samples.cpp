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
    const std::int32_t size = 4 << level;
    const LatticePoint corner{(p[0] & -size) | size / 2, p[1] & -size, p[2] & -size};
    return {point_key(corner), static_cast<std::size_t>((p[0] >> level & 3) | (p[1] >> level & 3) << 2 |
                                                        (p[2] >> level & 3) << 4)};
}

}  // namespace

std::int32_t Samples::find_or_add(const LatticePoint& p) {
    const Place place = place_of(p);
    std::int32_t& group = table_[place.group];
    if (group < 0) {
        group = static_cast<std::int32_t>(groups_.size());
        groups_.emplace_back().fill(-1);
    }
    std::int32_t& row = groups_[static_cast<std::size_t>(group)][place.within];
    if (row < 0) {
        row = static_cast<std::int32_t>(values_.size());
        values_.push_back(0);
    }
    return row;
}

std::int32_t Samples::find(const LatticePoint& p) const {
    const Place place = place_of(p);
    const std::int32_t group = table_.find(place.group);
    return group < 0 ? -1 : groups_[static_cast<std::size_t>(group)][place.within];
}

}  // namespace pfgeom
