// The point of a surface that is nearest to a place, or farthest along a direction, on the functions
// themselves, and a proof of how good it is.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/render/region_bound.h"
#include "pfgeom/render/surface_cells.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace pfgeom {

struct Extreme {
    Vec3 point;                                               ///< on the surface, if there is one
    double cost = std::numeric_limits<double>::infinity();    ///< of the point; infinity: none
    double proved = std::numeric_limits<double>::infinity();  ///< no point of the surface has a lower cost

    bool found() const { return cost < std::numeric_limits<double>::infinity(); }
};

/// For one thread; keeps its memory between searches.
///
/// Branch and bound over the cells, the most promising first: a cell's regions are bounded below by duality
/// (region_bound.h), and the point of a bound, moved onto the surface, bounds the answer above. The two meet
/// at once where the Lagrangian is convex (all planes, convex quadrics from outside, any function from closer
/// than its radius of curvature); else cells are divided.
class ExtremeSearch {
  public:
    /// Polls the task, which must outlive it.
    explicit ExtremeSearch(const Task& task) : task_(task) {}

    /// Looks for costs below `within` only. Ends when `proved` is within `accuracy` of the cost, or at a
    /// budget of cells. In the cube's units.
    Extreme run(const SurfaceCells& cells, const SearchGoal& goal, double within, double accuracy);

  private:
    struct Candidate {
        double bound = 0;
        std::int32_t cell = 0;  // of the octree; a leaf with its region
        Box box;
        SignRegion region;
    };

    bool is_inside(const Vec3& p) const;
    void look_at_box_sides();
    void open_node(const Candidate& node);
    void open_leaf(std::int32_t cell, const Box& box);
    void divide(const Candidate& leaf);
    void examine(std::int32_t cell, const Box& box, const SignRegion& region, double known);
    void offer(std::int32_t cell, const Box& box, const SignRegion& region, Vec3 point);
    Vec3 step_onto(std::int32_t leaf, const Condition& condition, const Vec3& point) const;
    bool belongs(std::int32_t leaf, const SignRegion& region, const Vec3& point) const;
    void push(const Candidate& candidate);
    void discard(double bound);
    void settle_on_surface();

    const Task& task_;
    const SurfaceCells* cells_ = nullptr;
    SearchGoal goal_;
    Side side_ = Side::inside;
    double within_ = 0, accuracy_ = 0;
    Extreme best_;
    std::vector<Candidate> pool_;
    std::vector<std::int32_t> free_, heap_;
    std::vector<SignRegion> regions_;
};

}  // namespace pfgeom
