// What is left of a set expression over functions in a cell, and where a ray changes sides in it.
#pragma once

#include "pfgeom/render/cell_function.h"
#include "pfgeom/render/folded_solid.h"
#include "pfgeom/render/ray_octree.h"

#include <span>
#include <vector>

namespace pfgeom {

/// A function that may change its sign in a cell.
struct LiveFunction {
    std::int32_t function = -1;  ///< row of the solid's functions
    CellFunction in_cell;
};

/// `function` and `decide` nodes name rows of `live`.
struct SolidLeaf {
    std::vector<SetNode> nodes;
    std::vector<LiveFunction> live;
};

/// One leaf along a ray.
class LeafRay {
  public:
    LeafRay(std::span<const FunctionTerms> functions, const SolidLeaf& leaf, const Ray& ray)
        : functions_(functions), leaf_(leaf), ray_(ray), squared_speed_(squared_norm(ray.direction)) {}

    LeafAnswer ask_solid(const RaySpan& span) const;
    /// The surface is the first live function: the ray meets it where the leaf would be inside with it.
    LeafAnswer ask_sheet(const RaySpan& span) const;

  private:
    LeafAnswer ask_alone(const RaySpan& span) const;
    double value(std::size_t i, double t) const;
    template <class Found>
    bool search(std::size_t i, const RaySpan& span, Found found) const;
    template <class Found>
    bool solve(const Quadric& quadric, const RaySpan& span, Found found) const;

    std::span<const FunctionTerms> functions_;
    const SolidLeaf& leaf_;
    const Ray& ray_;
    double squared_speed_;
};

}  // namespace pfgeom
