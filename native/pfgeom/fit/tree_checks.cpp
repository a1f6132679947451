#include "pfgeom/fit/tree_checks.h"

#include "pfgeom/mesh/edges.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Sharper creases than 120° would take coefficients without end; their retreat is left to the certificate.
constexpr double kLeastShare = 0.5;
// Three surfaces that meet at right angles intersect at √3 from their corner, two at √2 from their edge.
constexpr double kCornerShare = 0.816;
constexpr double kRoomToRound = 0.1;  // of the limit, beyond what the region's own quadric keeps

struct Corner {
    std::int32_t region, face;
};

class Checks {
  public:
    Checks(const TriangleMesh& mesh, const std::vector<Region>& regions, double limit)
        : mesh_(mesh),
          regions_(regions),
          limit_(limit),
          region_of_(mesh.faces.size(), 0),
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

    std::vector<std::vector<CheckPoint>> take() { return std::move(result_); }

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
            const double share = regions == 1 ? 1 : crease_share(corners_[i].region, regions);
            add_to(corners_[i].region, p, share);
        }
    }

    double crease_share(std::int32_t region, std::size_t regions) const {
        double least = 1;
        for (const Corner& mine : corners_) {
            if (mine.region != region) continue;
            for (const Corner& other : corners_) {
                if (other.region == region) continue;
                const double cosine = dot(normals_[mine.face], normals_[other.face]);
                least = std::min(least, std::sqrt(std::max(0.0, (1 + cosine) / 2)));
            }
        }
        const bool corner = regions > 2 && least < 0.9;
        return std::max(kLeastShare, corner ? least * kCornerShare : least);
    }

    void add_to(std::int32_t region, const Vec3& p, double share) {
        const double own = surface_distance(regions_[region].quadric, p) + kRoomToRound * limit_;
        result_[region].push_back({p, std::max(share * limit_, std::min(own, limit_))});
    }

    const TriangleMesh& mesh_;
    const std::vector<Region>& regions_;
    double limit_;
    std::vector<std::int32_t> region_of_;
    std::vector<Vec3> normals_;
    std::vector<Corner> corners_;
    std::vector<std::vector<CheckPoint>> result_;
};

}  // namespace

std::vector<std::vector<CheckPoint>> region_checks(const TriangleMesh& mesh,
                                                   const std::vector<Region>& regions, double limit) {
    Checks checks(mesh, regions, limit);
    checks.add_vertices();
    checks.add_edges();
    checks.add_centroids();
    return checks.take();
}

}  // namespace pfgeom
