// Rays against a set tree: an octree of pruned trees, each of which cuts the ray exactly.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/eval/pruned_tree.h"
#include "pfgeom/render/local_ray.h"
#include "pfgeom/render/ray_octree.h"
#include "pfgeom/render/ray_target.h"

#include <vector>

namespace pfgeom {

class RayTree final : public RayTarget {
  public:
    RayTree(const SetTree& tree, const Frame& frame, const Task& task);

    SurfaceHit first_hit(const Ray& world, const RaySpan& span) const override;
    std::vector<Box> cover() const override;
    std::size_t leaf_count() const { return first_.size(); }

  private:
    void make(const Task& task);
    SurfaceHit with_normal(SurfaceHit hit, const Ray& ray) const;

    CubePlace place_;
    TreePruner pruner_;
    std::size_t quadrics_;  // the first questions; then sides of the box, and cuts
    RayOctree octree_;
    PrunedTree nodes_;                 // of all leaves; `low` counts from the leaf's root
    std::vector<std::int32_t> first_;  // of each leaf: its root
};

}  // namespace pfgeom
