// Steps in a tree's mesh: strips of wall between two surfaces that face the same way but do not quite meet.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/polygonize/label_surface.h"
#include "pfgeom/polygonize/labelled_mesh.h"

namespace pfgeom {

/// Joins both sides of each wall that is no higher than `highest`: edges across it become their middles, or,
/// of steps no more than half as high, one of their ends. `mesh` stays a closed 2-manifold of its genus;
/// faces at joined borders are off their labels' surfaces, by less than the step.
void close_steps(const LabelSurface& surface, double highest, LabelledMesh& mesh, const Task& task);

}  // namespace pfgeom
