// The materials of an input surface: asked at any point near it.
#pragma once

#include "pfgeom/fit/material_tree.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// For each face of `prepared` the material of the input's face that it comes from: the one at the same three
/// points, or the closest where a seam was closed.
std::vector<std::int32_t> materials_after(const TriangleMesh& input, std::span<const std::int32_t> of_face,
                                          const TriangleMesh& prepared);

/// An edge between two materials.
struct BorderEdge {
    Vec3 from, to, normal;                    ///< of the surface there, about
    std::array<std::int32_t, 2> materials{};  ///< of three or more faces the first two that differ
};

class LabelledSurface {
  public:
    /// `several`: the mesh is made of parts that can lie on each other.
    LabelledSurface(const TriangleMesh& mesh, std::vector<std::int32_t> materials, bool several);

    bool plain() const { return !several_materials_; }
    std::int32_t any_material() const { return materials_.front(); }
    const std::vector<BorderEdge>& borders() const { return borders_; }

    /// What the surface has at the point next to p, and what it has within `near` of it beyond a border.
    MaterialSample ask(const Vec3& p, double near) const;

  private:
    void find_borders(const TriangleMesh& mesh);

    std::vector<std::int32_t> materials_;
    bool several_ = false, several_materials_ = false;
    std::vector<BorderEdge> borders_;
    Bvh faces_, edges_;
};

}  // namespace pfgeom
