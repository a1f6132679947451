// How far apart two shapes look from all around: depth buffers, the paper's judge of what it compressed.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/render/scene.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

struct DepthOptions {
    int side = 1024;       ///< pixels across each square drawing: 1 to Limits::picture_side
    double tolerance = 0;  ///< a length; pixels whose depths differ by more than three of it are counted
};

/// Counts of pixels and sums of |depth of a - depth of b|, in the shapes' units. A pixel is *away* unless
/// both drawings have a depth discontinuity within 2 pixels of it, in rows and in columns: a pixel whose
/// depth differs from a neighbour's in its row or column by more than 2 pixels' sides, or one of a covered
/// and an uncovered neighbour. (So a hole in b alone excuses nothing; and a surface that is displaced by the
/// tolerance along its normal differs by three of it only where it is steeper than the root of 8, which is
/// a jump of at least 2 in the row or the column.)
struct DepthFigures {
    std::int64_t both = 0, only_a = 0, only_b = 0;  ///< covered by
    double sum = 0, max = 0;                        ///< over those that both cover
    std::int64_t away = 0;                          ///< of those that both cover
    double away_sum = 0, away_max = 0;
    std::int64_t differing = 0, differing_away = 0;  ///< by more than three tolerances
    std::int64_t silhouette_away = 0;                ///< of those that one alone covers

    std::int64_t silhouette() const { return only_a + only_b; }
    double mean() const { return both > 0 ? sum / static_cast<double>(both) : 0; }
    double away_mean() const { return away > 0 ? away_sum / static_cast<double>(away) : 0; }
    DepthFigures& operator+=(const DepthFigures& other);
};

struct DepthView {
    Vec3 direction;    ///< of unit length: where the camera looks
    double pixel = 0;  ///< its side, in the shapes' units
    DepthFigures figures;
};

struct DepthComparison {
    std::vector<DepthView> views;  ///< along the 6 axes, then the 8 diagonals
    DepthFigures total;
};

/// Draws both orthographically with the same camera in each view, which sees all of both. The same figures
/// for any number of threads. InvalidInput: neither has a surface, or an option is out of range.
DepthComparison compare_depths(const RayScene& a, const RayScene& b, const DepthOptions& options,
                               const Task& task = {});

}  // namespace pfgeom
