// What merging or turning an edge would do to the mesh's error and shape, from the vertices' positions and
// normals alone: with unit normals n, n' at the ends of an edge and d from one to the other, the arc of the
// surface over the edge has the height |(n' - n)·d| / 8 up to third order.
#pragma once

#include "pfgeom/polygonize/surface_mesh.h"

#include <cmath>

namespace pfgeom {

class EdgeTests {
  public:
    explicit EdgeTests(const SurfaceMesh& mesh) : mesh_(mesh) {}

    double height(std::int32_t a, std::int32_t b) const {
        return std::abs(dot(mesh_.normal[b] - mesh_.normal[a], mesh_.position[b] - mesh_.position[a])) / 8;
    }
    double height(std::int32_t h) const { return height(mesh_.from(h), mesh_.to(h)); }
    double squared_length(std::int32_t h) const {
        return squared_norm(mesh_.position[mesh_.to(h)] - mesh_.position[mesh_.from(h)]);
    }
    /// Is the cosine between the triangle and its vertices' normals at least `facing`, and its height above
    /// `thinnest` times its longest side?
    bool faces_outside(std::int32_t a, std::int32_t b, std::int32_t c, double thinnest, double facing) const;
    /// Merging from(h) into to(h): no arc above the limit, no triangle turned over, no sliver.
    bool may_merge(std::int32_t h, double limit) const;
    /// Better the other way? That is an arc within the tolerance in place of one that is not, or else
    /// Delaunay's edge (the opposite angles add up to more than 180 degrees) if that keeps the tolerance as
    /// before. Neither undoes the other.
    bool should_flip(std::int32_t h, double tolerance) const;

  private:
    const SurfaceMesh& mesh_;
};

}  // namespace pfgeom
