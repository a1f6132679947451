#include "pfgeom/mesh/edges.h"

#include <algorithm>

namespace pfgeom {

EdgeTable::EdgeTable(std::span<const Triangle> faces, std::size_t vertices)
    : uses_(3 * faces.size()), starts_(vertices + 1, 0) {
    // A counting sort by lo leaves buckets of some three uses each.
    const auto lo_of = [](const Triangle& face, std::size_t corner) {
        return static_cast<std::size_t>(std::min(face[corner], face[(corner + 1) % 3]));
    };
    for (const Triangle& face : faces)
        for (std::size_t corner = 0; corner < 3; ++corner) ++starts_[lo_of(face, corner) + 1];
    for (std::size_t v = 0; v < vertices; ++v) starts_[v + 1] += starts_[v];

    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    std::int32_t side = 0;
    for (const Triangle& face : faces)
        for (std::size_t corner = 0; corner < 3; ++corner, ++side) {
            const auto [lo, hi] = std::minmax(face[corner], face[(corner + 1) % 3]);
            uses_[next[static_cast<std::size_t>(lo)]++] = {lo, hi, side, face[corner] == lo};
        }
    const auto before = [](const EdgeUse& a, const EdgeUse& b) {
        return a.hi != b.hi ? a.hi < b.hi : a.side < b.side;
    };
    for (std::size_t v = 0; v < vertices; ++v)
        std::sort(&uses_[0] + starts_[v], &uses_[0] + starts_[v + 1], before);
}

std::size_t EdgeTable::count(std::int32_t a, std::int32_t b) const {
    const auto [lo, hi] = std::minmax(a, b);
    const auto bucket = std::span(uses_).subspan(
        starts_[static_cast<std::size_t>(lo)],
        starts_[static_cast<std::size_t>(lo) + 1] - starts_[static_cast<std::size_t>(lo)]);
    const auto first =
        std::partition_point(bucket.begin(), bucket.end(), [hi = hi](const EdgeUse& u) { return u.hi < hi; });
    const auto last =
        std::partition_point(first, bucket.end(), [hi = hi](const EdgeUse& u) { return u.hi <= hi; });
    return static_cast<std::size_t>(last - first);
}

std::vector<std::int32_t> EdgeTable::boundary() const {
    std::vector<std::int32_t> sides;
    for_each([&](std::span<const EdgeUse> uses) {
        if (uses.size() == 1) sides.push_back(uses[0].side);
    });
    std::sort(sides.begin(), sides.end());
    return sides;
}

}  // namespace pfgeom
