#include "pfgeom/fit/tree_checks.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Sharper creases than 120° would take coefficients without end; their retreat is left to the certificate.
// Between whole quadrics, which have room elsewhere, they are held.
constexpr double kLeastShare = 0.5, kLeastOfWhole = 0.02, kLeastHeld = 0.002;
constexpr double kRoomToRound = 0.1;  // of the limit, beyond what the region's own quadric keeps
constexpr double kHeldAround = 2.5;   // tolerances

struct Corner {
    std::int32_t region, face;
};

class Checks {
  public:
    Checks(const TriangleMesh& mesh, const std::vector<Region>& regions, std::span<const Spot> held,
           double tolerance, double share)
        : mesh_(mesh),
          regions_(regions),
          held_(held),
          tolerance_(tolerance),
          share_(share),
          limit_(share * tolerance),
          region_of_(mesh.faces.size(), 0),
          spots_(regions.size()),
          result_(regions.size()) {
        for (std::size_t r = 0; r < regions.size(); ++r) {
            for (const std::int32_t f : regions[r].faces) region_of_[f] = static_cast<std::int32_t>(r);
        }
        for (const auto& [a, b, c] : mesh.faces) {
            const auto& v = mesh.vertices;
            normals_.push_back(normalized(cross(v[b] - v[a], v[c] - v[a])));
        }
    }

    void add_vertices() {
        std::vector<std::vector<std::int32_t>> faces(mesh_.vertices.size());
        for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
            for (const std::int32_t v : mesh_.faces[f]) faces[v].push_back(static_cast<std::int32_t>(f));
        }
        for (std::size_t v = 0; v < faces.size(); ++v) add(mesh_.vertices[v], faces[v]);
    }

    void add_edges() {
        std::vector<std::int32_t> faces;
        EdgeTable(mesh_.faces, mesh_.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
            faces.clear();
            for (const EdgeUse& use : uses) faces.push_back(use.face());
            add((mesh_.vertices[uses[0].lo] + mesh_.vertices[uses[0].hi]) * 0.5, faces);
        });
    }

    void add_centroids() {
        for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
            const auto& [a, b, c] = mesh_.faces[f];
            const Vec3 centroid = (mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c]) / 3;
            add(centroid, {static_cast<std::int32_t>(f)});
        }
    }

    std::vector<RegionChecks> take(const Task& task) {
        parallel_chunks(regions_.size(), 1, task, [&](std::size_t r, std::size_t) {
            if (!regions_[r].whole) {
                result_[r].sums = regions_[r].sums;
                return;
            }
            hold(spots_[r]);
            result_[r] = checks_of_whole(regions_[r], spots_[r], tolerance_, share_);
        });
        return std::move(result_);
    }

  private:
    // A point that these faces share goes to each of their regions.
    void add(const Vec3& p, const std::vector<std::int32_t>& faces) {
        corners_.clear();
        for (const std::int32_t f : faces) corners_.push_back({region_of_[f], f});
        std::ranges::stable_sort(corners_, {}, &Corner::region);
        std::size_t regions = 0;
        for (std::size_t i = 0; i < corners_.size(); ++i)
            regions += i == 0 || corners_[i].region != corners_[i - 1].region;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            if (i > 0 && corners_[i].region == corners_[i - 1].region) continue;
            const double share = regions == 1 ? 1 : crease_share(corners_[i].region);
            add_to(corners_[i].region, p, share);
        }
    }

    // The distance from the origin to the hull of the normals, those of the region among them.
    double crease_share(std::int32_t region) const {
        double least = 1;
        for (const Corner& mine : corners_) {
            if (mine.region != region) continue;
            const Vec3& n = normals_[mine.face];
            for (const Corner& b : corners_) {
                if (b.region == region) continue;
                for (const Corner& c : corners_) {
                    const Vec3 p = closest_point_on_triangle({}, n, normals_[b.face], normals_[c.face]);
                    least = std::min(least, squared_norm(p));
                }
            }
        }
        return std::max(regions_[region].whole ? kLeastOfWhole : kLeastShare, std::sqrt(least));
    }

    void add_to(std::int32_t region, const Vec3& p, double share) {
        if (regions_[region].whole) {
            spots_[region].push_back({p, share});
            return;
        }
        const double own = surface_distance(regions_[region].quadric, p) + kRoomToRound * limit_;
        result_[region].points.push_back({p, std::max(share * limit_, std::min(own, limit_))});
    }

    void hold(std::vector<Spot>& spots) const {
        const double around = kHeldAround * tolerance_;
        for (Spot& spot : spots) {
            double share = 1;
            for (const Spot& h : held_) {
                if (squared_norm(h.point - spot.point) <= around * around) share = std::min(share, h.share);
            }
            spot.share = std::max(share * spot.share, std::min(spot.share, kLeastHeld));
        }
    }

    const TriangleMesh& mesh_;
    const std::vector<Region>& regions_;
    std::span<const Spot> held_;
    double tolerance_, share_, limit_;
    std::vector<std::int32_t> region_of_;
    std::vector<Vec3> normals_;
    std::vector<Corner> corners_;
    std::vector<std::vector<Spot>> spots_;  // of whole quadrics
    std::vector<RegionChecks> result_;
};

}  // namespace

std::vector<RegionChecks> region_checks(const TriangleMesh& mesh, const std::vector<Region>& regions,
                                        std::span<const Spot> held, double tolerance, double share,
                                        const Task& task) {
    Checks checks(mesh, regions, held, tolerance, share);
    checks.add_vertices();
    checks.add_edges();
    checks.add_centroids();
    return checks.take(task);
}

}  // namespace pfgeom
