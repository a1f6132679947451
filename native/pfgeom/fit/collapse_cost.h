// What a collapse costs: an estimate by plane quadrics, and the true error of the patch that it makes.
#pragma once

#include "pfgeom/fit/collapse.h"
#include "pfgeom/fit/collapse_ahead.h"
#include "pfgeom/fit/plane_quadric.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

class CollapseCost {
  public:
    CollapseCost(const CollapseMesh& mesh, const CollapseError& error, const CollapseLimits& limits)
        : mesh_(mesh), error_(error), limits_(limits), quadrics_(plane_quadrics(mesh)) {}

    /// Of an edge, by its quadrics.
    CollapseEntry estimate(std::int32_t u, std::int32_t v, std::uint32_t clock) const;
    /// Of an estimate that says so: is the moving vertex near the plane of each face that goes?
    bool is_harmless(const Patch& patch) const;
    /// What is added to a cost, so that between equal ones shorter edges go first.
    double of_length(std::int32_t u, std::int32_t v) const;
    /// The place of the quadrics, fitted to the samples where that is better.
    MeasuredCollapse measure(std::int32_t u, std::int32_t v) const;
    /// u has been collapsed into v.
    void join(std::int32_t u, std::int32_t v) {
        quadrics_[static_cast<std::size_t>(v)] += quadrics_[static_cast<std::size_t>(u)];
    }

  private:
    double limit() const;
    double cost_of(const Patch& patch, double most) const;
    PlaneQuadric quadric(std::int32_t u, std::int32_t v) const;
    /// Of the vertex that the edge becomes.
    Vec3 place_of(const PlaneQuadric& q, std::int32_t u, std::int32_t v) const;
    bool on_border(std::int32_t v) const { return !mesh_.neighbours(v, false).empty(); }

    const CollapseMesh& mesh_;
    const CollapseError& error_;
    const CollapseLimits& limits_;
    std::vector<PlaneQuadric> quadrics_;
};

}  // namespace pfgeom
