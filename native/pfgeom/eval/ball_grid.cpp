#include "pfgeom/eval/ball_grid.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Calls visit(cell) for the cells of size r that the open ball around c meets.
template <class Visit>
void for_cells_of_ball(const Vec3& c, double r, Visit visit) {
    const CellIndex lo = CellIndex::of(c - Vec3{r, r, r}, 1 / r),
                    hi = CellIndex::of(c + Vec3{r, r, r}, 1 / r);
    for (std::int32_t x = lo.x; x <= hi.x; ++x) {
        for (std::int32_t y = lo.y; y <= hi.y; ++y) {
            for (std::int32_t z = lo.z; z <= hi.z; ++z) {
                const Vec3 corner{x * r, y * r, z * r};
                const Box box{corner, corner + Vec3{r, r, r}};
                // The margin covers the rounding of corner and quotient: a list is a superset.
                if (box.squared_distance(c) < r * r * (1 + 1e-9)) visit(CellIndex{x, y, z});
            }
        }
    }
}

}  // namespace

BallGrid::BallGrid(std::span<const Vec3> centres, double radius)
    : radius_(radius), inverse_radius_(1 / radius), inverse_squared_(1 / (radius * radius)) {
    // Counting sort by cell: cells get numbers as they are met, balls stay in order.
    std::vector<std::uint32_t> counts;
    for (const Vec3& c : centres) {
        for_cells_of_ball(c, radius, [&](const CellIndex& cell) {
            std::int32_t& number = table_[cell.key()];
            if (number < 0) {
                number = static_cast<std::int32_t>(cells_.size());
                cells_.push_back(cell);
                counts.push_back(0);
            }
            ++counts[static_cast<std::size_t>(number)];
        });
    }
    first_.assign(cells_.size() + 1, 0);
    for (std::size_t i = 0; i < cells_.size(); ++i) first_[i + 1] = first_[i] + counts[i];
    entries_.resize(first_.back());
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    for (std::size_t b = 0; b < centres.size(); ++b) {
        for_cells_of_ball(centres[b], radius, [&](const CellIndex& cell) {
            const auto number = static_cast<std::size_t>(table_[cell.key()]);
            entries_[at[number]++] = {centres[b], static_cast<std::int32_t>(b)};
        });
    }
}

}  // namespace pfgeom
