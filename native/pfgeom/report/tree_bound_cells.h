// Model to mesh: depth-first search of octree cells for points that are far from the mesh and on the wrong
// side.
#pragma once

#include "pfgeom/eval/pruned_tree.h"
#include "pfgeom/report/tree_bound_findings.h"
#include "pfgeom/report/tree_bound_side.h"

#include <deque>
#include <vector>

namespace pfgeom {

// What the searches read.
struct TreeBoundProblem {
    const TreePruner& pruner;
    const SurfaceSides& sides;
    Box box;           // of the tree
    double tolerance;  // less what distances may be off by
    const TreeBoundOptions& options;
    const Task& task;
};

struct TreeBoundCell {
    Box box;
    PrunedTree tree;        // what is left of the model in the box
    Interval distance;      // holds the signed distance of the centre
    SignedClosest closest;  // to the centre if `measured`, else some near face
    bool measured = false;

    Vec3 centre() const { return box.centre(); }
    Vec3 half() const;
    double radius() const;  // of the ball around the box
    double side() const;    // the longest
    bool splits(int axis) const { return box.extent()[axis] > 0.6 * side(); }
    bool has_child(int corner) const;
};

class CellSearch {
  public:
    /// `refuted`: a counter-example is known, others are looked for.
    CellSearch(const TreeBoundProblem& problem, std::size_t labels_kept, std::uint64_t seed, bool refuted);

    /// Of all that the tree and the mesh reach.
    TreeBoundCell root() const;
    /// All of the cell, down to where nothing is left to decide; gives up after so many cells.
    void run(const TreeBoundCell& cell, std::int64_t max_cells);
    /// Adds the children of the cell unless it can be closed.
    void split(TreeBoundCell& cell, std::vector<TreeBoundCell>& children);

    const TreeBoundFindings& found() const { return found_; }

  private:
    bool closed(TreeBoundCell& cell);
    bool pure_closed(TreeBoundCell& cell);
    bool mixed_closed(TreeBoundCell& cell);
    bool far_closed(TreeBoundCell& cell);
    bool slab_closed(const TreeBoundCell& cell);
    void descend(TreeBoundCell& cell, std::size_t level);
    void make_child(const TreeBoundCell& parent, int corner, TreeBoundCell& child) const;

    void measure(TreeBoundCell& cell);
    void need(const TreeBoundCell& cell);
    bool refute(const Vec3& p, std::int32_t hint);
    bool probed_wrong(const TreeBoundCell& cell);
    double finest() const;
    bool give_up_closed(const TreeBoundCell& cell, bool inside);

    TreeBoundProblem problem_;
    TreeBoundFindings found_;
    bool refuted_;
    std::int64_t cells_left_ = 0;
    std::deque<TreeBoundCell> levels_;  // scratch
    std::vector<std::int32_t> faces_;
    std::vector<Vec3> points_;
    PrunedTree part_;
};

}  // namespace pfgeom
