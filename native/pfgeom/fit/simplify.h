// The fitter of the mesh part: the fewest triangles within a tolerance.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/halves.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>
#include <limits>
#include <optional>

namespace pfgeom {

struct MeshPartOptions {
    double tolerance = 0;  ///< in the mesh's units
    Metric metric = Metric::max;
    /// Share of the tolerance that is used (the closed loop lowers it when a measurement fails); 0: no
    /// simplification, finest quantisation: the safety net, which always holds the tolerance.
    double share = 1.0;
    bool curved = false;  ///< faces are quadratic Bézier triangles, unless share is 0
    /// The part is to be mirrored in this plane, the half above it fitted to both halves. Only with a share
    /// above 0.
    std::optional<AxisPlane> mirror = {};
    /// Gives up, without a face, where collapses leave more. Only with a share above 0.
    std::size_t most_faces = std::numeric_limits<std::size_t>::max();
};

/// Simplifies by edge collapses ordered by the true two-sided error, then quantises; the result, dequantised,
/// is aimed to lie within share * tolerance of `mesh` both ways. Any triangle soup goes in; borders stay
/// within the tolerance too. Deterministic. In canonical order (codec's business) only after `canonical()`.
Object fit_mesh_part(const TriangleMesh& mesh, const MeshPartOptions& options, const Task& task = {});

}  // namespace pfgeom
