// Rays against a solid or a sheet: an octree of cells, each with the functions that change their sign in it
// and their live perturbations.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/trim.h"
#include "pfgeom/render/local_ray.h"
#include "pfgeom/render/ray_octree.h"
#include "pfgeom/render/ray_target.h"
#include "pfgeom/render/solid_leaf.h"
#include "pfgeom/render/surface_cells.h"

#include <vector>

namespace pfgeom {

class RaySolid final : public RayTarget, private SurfaceCells {
  public:
    RaySolid(const Model& model, const Solid& solid, const Frame& frame, const Task& task);
    RaySolid(const Model& model, const Sheet& sheet, const Frame& frame, const Task& task);

    SurfaceHit first_hit(const Ray& world, const RaySpan& span) const override;
    Extreme extreme(const SearchGoal& goal, double within, double accuracy,
                    ExtremeSearch& search) const override;
    std::vector<Box> cover() const override;
    std::size_t leaf_count() const { return leaves_.size(); }

  private:
    std::int32_t add(const Model& model, std::int32_t function);
    void add_trim(const Trim& trim);
    SolidLeaf whole() const;
    Box box() const;
    SolidLeaf in_cell(const SolidLeaf& parent, const Box& cell) const;
    void make(const Task& task);
    const RayOctree& octree() const override { return octree_; }
    bool open() const override { return open_; }
    void regions(std::int32_t leaf, Side side, std::vector<SignRegion>& regions) const override;
    Expansion expand(std::int32_t leaf, std::int32_t function, const Vec3& at) const override;
    bool is_inside(std::int32_t leaf, const Vec3& p) const override;
    SurfaceHit with_normal(SurfaceHit hit, const Ray& ray, std::int32_t leaf) const;

    CubePlace place_;
    bool open_ = false;           // a sheet: the surface is the first function, of leaves too
    std::vector<SetNode> nodes_;  // `function` and `decide` name rows of functions_
    std::vector<FunctionTerms> functions_;
    std::vector<std::int32_t> rows_;  // of functions_: rows of Model::functions; -1: a trim's
    RayOctree octree_;
    std::vector<SolidLeaf> leaves_;
};

}  // namespace pfgeom
