// Stage 2: the regions of a surface that one quadric serves.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/segment/exact_patches.h"
#include "pfgeom/segment/power_sums.h"
#include "pfgeom/segment/whole_quadrics.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

struct Region {
    std::vector<std::int32_t> faces;  ///< rows of the mesh's faces, rising; not always connected
    PowerSums sums;                   ///< of the faces, those weighted that the quadric misses most
    double area = 0;
    Quadric quadric;                  ///< positive inside; serves all check points of the faces
    bool whole = false;               ///< a whole quadric's
    std::vector<HiddenPoint> hidden;  ///< of that
};

struct SegmentOptions {
    double tolerance = 0;  ///< of the check points, a distance
    std::size_t most_regions = static_cast<std::size_t>(-1);
    /// Mean |∇q + n|² of a region: facets of a cylinder of sixteen sides have 0.013, two faces at 45° 0.15, a
    /// cone up to its tip 0.11, since its gradients shrink towards it.
    double most_misalignment = 0.08;
    /// Of regions apart that one quadric serves about as well, the farthest are joined first, not the
    /// smallest.
    bool outermost_first = false;
    std::size_t hosts = 400;  ///< so many largest regions are tried against all others that lie apart
    std::span<const WholeQuadric> whole = {};  ///< regions from the beginning, never merged
    std::span<const ExactPatch> exact = {};    ///< of the mesh: regions from the beginning
};

/// Nothing if there are more than options.most_regions. Regions by falling area: neighbours merged best
/// first, then regions apart that lie on one quadric.
std::vector<Region> segment(const TriangleMesh& mesh, const SegmentOptions& options, const Task& task = {});

}  // namespace pfgeom
