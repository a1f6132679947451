// Mesh to model: every point of the mesh needs a change of the tree's label within the tolerance.
#pragma once

#include "pfgeom/report/piece.h"
#include "pfgeom/report/tree_bound_cells.h"

#include <deque>
#include <span>

namespace pfgeom {

class PieceSearch {
  public:
    PieceSearch(const TreeBoundProblem& problem, std::uint64_t seed)
        : problem_(problem), found_(problem.options, 0, seed) {}

    void run(std::span<const std::int32_t> faces);
    const TreeBoundFindings& found() const { return found_; }

  private:
    void descend(const Corners& piece, const Vec3& normal, const PrunedTree& parent, std::size_t level);
    bool settled(const Corners& piece, const Vec3& normal, const PrunedTree& tree, double reach);
    bool changes_across(const Corners& piece, const Vec3& normal, const PrunedTree& tree, double reach);
    void concede(const Corners& piece, const Vec3& normal, const PrunedTree& tree);
    void lose(const Corners& piece);
    void miss(const Corners& piece);

    TreeBoundProblem problem_;
    TreeBoundFindings found_;
    std::deque<PrunedTree> levels_;  // scratch
    PrunedTree part_;
};

}  // namespace pfgeom
