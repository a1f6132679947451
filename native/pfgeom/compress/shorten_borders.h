// The border between two materials, where the tolerance leaves a choice.
#pragma once

#include "pfgeom/compress/labelled_surface.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Where the border is, and how far from it a face may have the material beyond.
struct BorderGoal {
    const LabelledSurface& surface;
    double tolerance = 0;
};

/// Gives leaves of the tree, where every face of theirs allows it, the material with which borders are
/// shortest, and takes questions away whose answers are one then: bits of one material in another go, and so
/// do teeth. `mesh`: the object's, in place.
void shorten_borders(const TriangleMesh& mesh, const Frame& frame, const BorderGoal& goal, MaterialTree& tree,
                     const Task& task);

}  // namespace pfgeom
