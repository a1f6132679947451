// Where a mesh has creases: near them normals of two surfaces differ, however close the surfaces are.
#pragma once

#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// Edges whose faces turn by more than 30 degrees, or that more than two faces share. Vertices at the same
/// place count as one; a border is no crease.
class Creases {
  public:
    explicit Creases(const TriangleMesh& mesh, const Task& task = {});

    bool within(const Vec3& p, double distance) const { return edges_.closest(p, distance).face >= 0; }

  private:
    Bvh edges_;  // as triangles without area
};

}  // namespace pfgeom
