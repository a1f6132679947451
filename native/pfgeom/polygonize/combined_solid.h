// A model's combination as what the cutting polygonizer takes.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"
#include "pfgeom/polygonize/cut_solid.h"

namespace pfgeom {

/// In the coordinates of the frame's cube. Quadrics stay quadrics; functions with perturbations and mesh
/// parts become fields. Throws InvalidInput if an object is a sheet, and LimitExceeded where copies and
/// shared parts of expressions add up to too much.
CutSolid combined_solid(const Model& model, const Frame& frame, const Task& task = {});
/// A solid of the model in its own cube.
CutSolid combined_solid(const Model& model, const Solid& solid, const Task& task = {});

}  // namespace pfgeom
