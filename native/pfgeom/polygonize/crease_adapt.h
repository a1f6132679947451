// From the first labelled mesh to one with as few triangles as the tolerance allows.
#pragma once

#include "pfgeom/polygonize/adapt.h"
#include "pfgeom/polygonize/label_surface.h"
#include "pfgeom/polygonize/labelled_mesh.h"

namespace pfgeom {

/// Puts vertices on the quadrics of their faces (on creases and corners: on all of them), then merges, splits
/// and turns edges; creases stay edges. `mesh` stays a closed 2-manifold.
void adapt_creases(const LabelSurface& surface, const AdaptOptions& options, LabelledMesh& mesh,
                   const Task& task);

}  // namespace pfgeom
