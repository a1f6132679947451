// Which balls of one radius hold a point: a grid of cells as large as the radius, each listing every ball
// that meets it, in the balls' order. A point looks into one cell only.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/eval/cell_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

class BallGrid {
  public:
    struct Entry {
        Vec3 centre;
        std::int32_t ball = 0;  ///< row of the centres given
    };

    BallGrid() = default;
    BallGrid(std::span<const Vec3> centres, double radius);

    double radius() const { return radius_; }

    /// The balls that may hold p: a superset, in rising order.
    std::span<const Entry> candidates(const Vec3& p) const {
        return list(table_.find(CellIndex::of(p, inverse_radius_).key()));
    }
    /// Calls visit(ball, q, p - centre) for each ball with q = 1 - |p-c|²/r² > 0.
    template <class Visit>
    void near(const Vec3& p, Visit visit) const {
        for (const Entry& e : candidates(p)) {
            const Vec3 d = p - e.centre;
            const double q = 1 - squared_norm(d) * inverse_squared_;
            if (q > 0) visit(e.ball, q, d);
        }
    }
    /// Cells that hold any ball, and the list of each.
    std::size_t cell_count() const { return cells_.size(); }
    CellIndex cell(std::size_t i) const { return cells_[i]; }
    std::span<const Entry> list(std::int32_t cell) const {
        if (cell < 0) return {};
        const auto i = static_cast<std::size_t>(cell);
        return std::span(entries_).subspan(first_[i], first_[i + 1] - first_[i]);
    }
    std::int32_t find(const CellIndex& cell) const { return table_.find(cell.key()); }

  private:
    double radius_ = 0, inverse_radius_ = 0, inverse_squared_ = 0;
    CellTable table_;
    std::vector<CellIndex> cells_;
    std::vector<std::uint32_t> first_;
    std::vector<Entry> entries_;
};

}  // namespace pfgeom
