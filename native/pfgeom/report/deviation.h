// The public header of the judge: how far two surfaces are from each other, by code that fitting does not
// use.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>

namespace pfgeom {

/// Angles between the normals at the samples, in degrees.
struct NormalAngles {
    double mean = 0, p99 = 0, max = 0;
};

/// Of the points of one surface to the other.
struct OneSided {
    double max = 0;        ///< largest distance found at a point: a lower bound of the true maximum
    double max_bound = 0;  ///< proved upper bound of the true maximum
    double rms = 0, mean = 0, p99 = 0;  ///< over the surface's area, by stratified quadrature
    Vec3 worst;                         ///< the point where `max` was found
    NormalAngles normals;
    NormalAngles smooth_normals;  ///< of the samples away from creases, if asked for
};

struct Deviation {
    OneSided a_to_b, b_to_a;
    bool certified = false;  ///< max_bound closed to within `gap` of max, both ways, or below `certify_below`
    double max() const;
    double max_bound() const;
    double rms() const;
    double mean() const;
    double p99() const;
    NormalAngles normals() const;
    NormalAngles smooth_normals() const;
};

struct DeviationOptions {
    std::size_t samples = 200'000;  ///< a side, for rms, mean, p99, normals; 0: leave these out
    std::uint64_t seed = 1;
    /// Also `smooth_normals`: of samples that lie, with their closest points, farther than 5e-3 of the first
    /// mesh's diagonal from its creases (edges that turn by more than 30 degrees).
    bool smooth_normals = false;
    bool bound = true;         ///< branch and bound for the maximum
    double gap = 0.005;        ///< relative gap at which the bound counts as closed
    double certify_below = 0;  ///< > 0: only prove (or refute) max <= this: much cheaper than finding it
    std::int64_t work = 40'000'000;  ///< closest-point queries that the bound may spend; counted, no clock
};

/// Two-sided deviation between the surfaces of a and b, in their units. Throws InvalidInput for an empty
/// mesh.
Deviation measure_deviation(const TriangleMesh& a, const TriangleMesh& b,
                            const DeviationOptions& options = {}, const Task& task = {});
/// The same with hierarchies that exist already.
Deviation measure_deviation(const TriangleMesh& a, const Bvh& bvh_a, const TriangleMesh& b, const Bvh& bvh_b,
                            const DeviationOptions& options = {}, const Task& task = {});

}  // namespace pfgeom
