// Surface area and volume of a model.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

struct SurfaceSize {
    double area = 0;
    /// Of the closed objects together, less their cavities. Objects that overlap count each for itself. What
    /// is inside is that of ModelField: an object that faces inwards encloses volume like any other. Sheets,
    /// and mesh parts with a border, have none.
    double volume = 0;
};

/// Over triangles no further than `tolerance` (in the mesh's units) from the surface: the volume is within
/// tolerance · area, to first order. Throws InvalidInput, LimitExceeded, Cancelled.
SurfaceSize surface_size(const Model& model, double tolerance, const Task& task = {});

}  // namespace pfgeom
