// Greedy edge collapses: quadrics propose the place of the new vertex, the true two-sided error decides.
// Source: Garland, Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997. Departures:
// the order and the limit are those of the true error; where the quadrics' place is not good enough, the
// vertex is fitted to the samples of the original surface; between rounds of collapses all vertices are
// fitted so.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse_error.h"
#include "pfgeom/fit/collapse_mesh.h"

#include <limits>

namespace pfgeom {

struct CollapseLimits {
    Metric metric = Metric::max;
    double forward = 0;        ///< max: of every sample; rms: of the mean over the surface
    double backward = 0;       ///< of every point of the new surface
    double size = 1;           ///< diagonal: between equal errors, shorter edges go first
    bool keep_places = false;  ///< flat faces: no vertex moves, an edge becomes one of its ends
};

/// Collapses until nothing more fits within the limits. Reports progress in [from, to].
void collapse_edges(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Task& task);

/// Moves each vertex to where its samples fit better.
void relax_vertices(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Task& task);

/// Between the samples of an error on large faces and edges; at most so many on a face in the mean.
double collapse_spacing(const TriangleMesh& original, double tolerance,
                        double samples_of_face = std::numeric_limits<double>::infinity());

}  // namespace pfgeom
