#include "pfgeom/eval/sum_bounds.h"

namespace pfgeom {
namespace {

void unite(Interval& a, const Interval& b) {
    a.lo = std::min(a.lo, b.lo);
    a.hi = std::max(a.hi, b.hi);
}

CellIndex parent_of(const CellIndex& c) {
    return {c.x >> 1, c.y >> 1, c.z >> 1};
}

}  // namespace

SumBounds::SumBounds(const BallGrid& grid, std::span<const double> factors) {
    if (grid.cell_count() == 0) return;
    Scale finest;
    finest.inverse_size = 1 / grid.radius();
    std::vector<CellIndex> cells;
    for (std::size_t i = 0; i < grid.cell_count(); ++i) {
        Interval sum;
        for (const BallGrid::Entry& e : grid.list(static_cast<std::int32_t>(i))) {
            const double f = factors[static_cast<std::size_t>(e.ball)];
            (f < 0 ? sum.lo : sum.hi) += f;
        }
        cells.push_back(grid.cell(i));
        finest.table[cells.back().key()] = static_cast<std::int32_t>(i);
        finest.sums.push_back(sum);
    }
    scales_.push_back(std::move(finest));
    while (1 / scales_.back().inverse_size < 2) {  // up to the size of the cube
        const Scale& fine = scales_.back();
        Scale coarse;
        coarse.inverse_size = fine.inverse_size / 2;
        std::vector<CellIndex> parents;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const CellIndex parent = parent_of(cells[i]);
            std::int32_t& number = coarse.table[parent.key()];
            if (number < 0) {
                number = static_cast<std::int32_t>(parents.size());
                parents.push_back(parent);
                coarse.sums.emplace_back();
            }
            unite(coarse.sums[static_cast<std::size_t>(number)], fine.sums[i]);
        }
        cells.swap(parents);
        scales_.push_back(std::move(coarse));
    }
}

Interval SumBounds::over(const Box& box) const {
    Interval result;
    if (scales_.empty()) return result;
    const Vec3 extent = box.extent();
    const double largest = std::max({extent.x, extent.y, extent.z});
    std::size_t k = 0;
    while (k + 1 < scales_.size() && largest * scales_[k].inverse_size > 1) ++k;
    const Scale& scale = scales_[k];
    const CellIndex lo = CellIndex::of(box.lo, scale.inverse_size),
                    hi = CellIndex::of(box.hi, scale.inverse_size);
    for (std::int32_t x = lo.x; x <= hi.x; ++x) {
        for (std::int32_t y = lo.y; y <= hi.y; ++y) {
            for (std::int32_t z = lo.z; z <= hi.z; ++z) {
                const std::int32_t i = scale.table.find(CellIndex{x, y, z}.key());
                if (i >= 0) unite(result, scale.sums[static_cast<std::size_t>(i)]);
            }
        }
    }
    return result;
}

}  // namespace pfgeom
