// Triangles of a labelled mesh that show the inside of their quadrics, and slivers as flat as a line.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/polygonize/adapt.h"
#include "pfgeom/polygonize/label_surface.h"
#include "pfgeom/polygonize/labelled_mesh.h"

namespace pfgeom {

/// Turns edges, merges and moves vertices until none is left, or none that can be mended so without an arc
/// above the tolerance.
void mend_creases(const LabelSurface& surface, const AdaptOptions& options, LabelledMesh& mesh,
                  const Task& task);

}  // namespace pfgeom
