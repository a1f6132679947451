// What the fitters of the mesh part begin with: all of a mesh, or the half above a mirror's plane, which is
// fitted to both halves, laid on each other: then it need not be exactly symmetric.
#pragma once

#include "pfgeom/fit/collapse_error.h"
#include "pfgeom/fit/collapse_mesh.h"
#include "pfgeom/fit/simplify.h"

namespace pfgeom {

class FittedSurface {
  public:
    FittedSurface(const TriangleMesh& mesh, const MeshPartOptions& options);

    /// With the plane of the mirror, if there is one.
    Grid grid(double step) const;
    CollapseMesh start(bool curved) const;
    CollapseError error(double tolerance, double spacing, const Task& task) const;
    /// That all is measured against.
    const TriangleMesh& original() const { return half_ ? both_ : mesh_; }
    const Box& box() const { return box_; }

  private:
    const TriangleMesh& mesh_;
    Metric metric_;
    double goal_;
    Box box_;
    std::optional<MirrorPlane> mirror_;
    std::optional<AxisPlane> plane_;  // as the grid has it
    std::optional<TriangleMesh> half_;
    TriangleMesh both_;
};

}  // namespace pfgeom
