// Rays against a set tree: an octree of pruned trees, each of which cuts the ray exactly.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/eval/pruned_tree.h"
#include "pfgeom/render/local_ray.h"
#include "pfgeom/render/ray_octree.h"
#include "pfgeom/render/ray_target.h"
#include "pfgeom/render/surface_cells.h"

#include <span>
#include <vector>

namespace pfgeom {

class RayTree final : public RayTarget, private SurfaceCells {
  public:
    RayTree(const SetTree& tree, const Frame& frame, const Task& task);

    SurfaceHit first_hit(const Ray& world, const RaySpan& span) const override;
    Extreme extreme(const SearchGoal& goal, double within, double accuracy,
                    ExtremeSearch& search) const override;
    std::vector<Box> cover() const override;
    std::size_t leaf_count() const { return first_.size(); }

  private:
    void make(const Task& task);
    const RayOctree& octree() const override { return octree_; }
    bool open() const override { return false; }
    void regions(std::int32_t leaf, Side side, std::vector<SignRegion>& regions) const override;
    Expansion expand(std::int32_t leaf, std::int32_t function, const Vec3& at) const override;
    bool is_inside(std::int32_t leaf, const Vec3& p) const override;
    std::span<const PrunedNode> nodes_of(std::int32_t leaf) const {
        return std::span(nodes_).subspan(static_cast<std::size_t>(first_[static_cast<std::size_t>(leaf)]));
    }
    SurfaceHit with_normal(SurfaceHit hit, const Ray& ray) const;

    CubePlace place_;
    TreePruner pruner_;
    std::size_t quadrics_;  // the first questions; then sides of the box, and cuts
    RayOctree octree_;
    PrunedTree nodes_;                 // of all leaves; `low` counts from the leaf's root
    std::vector<std::int32_t> first_;  // of each leaf: its root
};

}  // namespace pfgeom
