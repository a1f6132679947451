// Regions that are being merged, and the question whether a quadric serves one.
#pragma once

#include "pfgeom/segment/segment.h"

#include <array>
#include <optional>
#include <vector>

namespace pfgeom {

/// A lower bound of the distance from p to the quadric's surface, near the truth close to it: the d at which
/// the value g d + h d²/2 can be reached, with the gradient's length g and the largest second derivative h
/// (Taubin, "Distance approximations for rasterizing implicit curves", ACM TOG 13(1), 1994). The first order
/// alone has no answer at the tip of a cone, and a floor under g hides what misses the thin end of one by
/// several tolerances.
double surface_distance(const Quadric& q, const Vec3& p);

/// surface_distance(q, p) <= distance, but for rounding.
bool within(const Quadric& q, const Vec3& p, double distance);

/// Corners, edge middles and centroid: where a triangle is checked.
std::array<Vec3, 7> check_points(const TriangleMesh& mesh, std::int32_t face);

class RegionSet {
  public:
    /// A region for each face.
    RegionSet(const TriangleMesh& mesh, double tolerance, double most_misalignment);

    /// What merging would cost, from the sums alone: nothing if they tell that no quadric serves both. Rising
    /// with the error, in steps, and among equals with the size: balanced merging touches a face log n times.
    std::optional<double> cost(std::int32_t a, std::int32_t b) const;
    /// Makes one region of both, with the lower number, if one quadric serves all their faces: that of least
    /// squares, or, if `refine`, one that gives the worst faces more weight.
    bool merge(std::int32_t a, std::int32_t b, bool refine = false);
    /// Lets the quadric of every region miss its worst point by less, where that can be done.
    void refine_all(const Task& task);

    /// Makes one region, with the lowest number, of these faces that are regions of their own, if one quadric
    /// serves them all. `faces` rise.
    bool unite(const std::vector<std::int32_t>& faces);
    /// Makes one region, that is never merged, of the quadric's faces, which are regions of their own.
    void unite(const WholeQuadric& whole);

    std::size_t size(std::int32_t region) const { return regions_[region].faces.size(); }
    double area(std::int32_t region) const { return regions_[region].area; }
    bool merges(std::int32_t region) const {
        return !regions_[region].faces.empty() && !regions_[region].whole;
    }
    Vec3 centroid(std::int32_t region) const { return regions_[region].sums.centroid(); }
    std::vector<Region> take();  ///< those with faces, by falling area

  private:
    Region sum_of(const std::vector<std::int32_t>& faces) const;
    bool serves(const Quadric& q, const Region& region) const;
    double worst_error(const Quadric& q, const Region& region) const;
    void refine(Region& region, double enough) const;

    const TriangleMesh& mesh_;
    double tolerance_, most_misalignment_, normal_weight_ = 0;
    std::vector<Region> regions_;
};

}  // namespace pfgeom
