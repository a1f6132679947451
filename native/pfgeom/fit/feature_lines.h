// Borders and creases of the original surface, which edges of curved faces are to follow.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/spokes.h"
#include "pfgeom/mesh/bvh.h"

namespace pfgeom {

class FeatureLines {
  public:
    explicit FeatureLines(const TriangleMesh& original, const Task& task);

    /// The spokes of a patch with the lines that they follow: borders, and creases that both ends are on,
    /// within `near`.
    Spokes spokes_of(const Patch& patch, double near) const;

  private:
    Bvh borders_, creases_;  // of segments: triangles whose last two corners are one
};

}  // namespace pfgeom
