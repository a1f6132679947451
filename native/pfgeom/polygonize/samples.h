// The field at corners of cells, each evaluated once: append-only rows with an index. Neighbours are asked
// for one after another, so that the index keeps those of 4³ points of a grid together.
#pragma once

#include "pfgeom/eval/cell_table.h"
#include "pfgeom/polygonize/lattice.h"

#include <vector>

namespace pfgeom {

class Samples {
  public:
    using Normal = std::array<float, 3>;  ///< unit gradient; zero where the gradient is

    static Normal normal_of(const Vec3& gradient) {
        const Vec3 n = is_finite(gradient) ? normalized(gradient) : Vec3{};
        return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    }

    /// Row of the sample at `p`; where there is none yet a new one, the last, is appended.
    std::int32_t find_or_add(const LatticePoint& p);
    /// -1 where there is none.
    std::int32_t find(const LatticePoint& p) const;

    std::size_t size() const { return values_.size(); }
    double value(std::int32_t row) const { return values_[static_cast<std::size_t>(row)]; }
    const Normal& normal(std::int32_t row) const { return normals_[static_cast<std::size_t>(row)]; }
    void set(std::size_t row, double value) { values_[row] = value; }
    void set(std::size_t row, double value, const Normal& normal) {
        values_[row] = value;
        normals_[row] = normal;
    }
    /// Room for the normals of all rows so far.
    void add_normals() { normals_.resize(values_.size()); }

  private:
    using Group = std::array<std::int32_t, 64>;  // rows; -1 where there is none
    std::vector<double> values_;
    std::vector<Normal> normals_;  // of the first rows
    CellTable table_;              // rows of groups_
    std::vector<Group> groups_;
};

}  // namespace pfgeom
