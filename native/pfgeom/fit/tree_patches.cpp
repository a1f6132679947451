#include "pfgeom/fit/tree_patches.h"

#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

constexpr double kLeastAlignment = 0.8;  // cosine to the face's normal; which side is inside does not matter

bool serves(const Quadric& q, const TriangleMesh& mesh, std::int32_t face, double limit) {
    const auto points = check_points(mesh, face);
    const Vec3 n = normalized(cross(points[1] - points[0], points[2] - points[0]));
    const Vec3 g = q.gradient(points[6]);
    return std::abs(dot(g, n)) >= kLeastAlignment * norm(g) &&
           std::ranges::all_of(points, [&](const Vec3& p) { return surface_distance(q, p) <= limit; });
}

class Assignment {
  public:
    Assignment(const TriangleMesh& mesh, const std::vector<Region>& regions,
               const std::vector<QuantisedQuadric>& own, double limit)
        : mesh_(mesh), regions_(regions), own_(own), limit_(limit), alive_(regions.size(), 1) {
        patches_.of_face.assign(mesh.faces.size(), 0);
        for (std::size_t r = 0; r < regions.size(); ++r) {
            for (const std::int32_t f : regions[r].faces) patches_.of_face[f] = static_cast<std::int32_t>(r);
        }
    }

    Patches run() {
        for (std::size_t r = regions_.size(); r-- > 0;) give_up(r);
        std::vector<std::int32_t> number(regions_.size(), -1);
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            if (alive_[r] == 0) continue;
            number[r] = static_cast<std::int32_t>(patches_.quadrics.size());
            patches_.quadrics.push_back(own_[r]);
        }
        for (std::int32_t& patch : patches_.of_face) patch = number[patch];
        return std::move(patches_);
    }

  private:
    void give_up(std::size_t region) {
        std::vector<std::pair<std::int32_t, std::int32_t>> moves;  // face, region
        std::int32_t last = 0;
        for (std::size_t f = 0; f < patches_.of_face.size(); ++f) {
            if (patches_.of_face[f] != static_cast<std::int32_t>(region)) continue;
            const auto face = static_cast<std::int32_t>(f);
            last = other_for(face, static_cast<std::int32_t>(region), last);
            if (last < 0) return;
            moves.emplace_back(face, last);
        }
        alive_[region] = 0;
        for (const auto& [face, other] : moves) patches_.of_face[face] = other;
    }

    // The largest other region whose quadric serves the face, `first` before all; -1: none.
    std::int32_t other_for(std::int32_t face, std::int32_t region, std::int32_t first) const {
        const auto good = [&](std::int32_t r) {
            return r != region && alive_[r] != 0 && serves(own_[r].quadric.quadric, mesh_, face, limit_);
        };
        if (good(first)) return first;
        for (std::int32_t r = 0; r < static_cast<std::int32_t>(regions_.size()); ++r) {
            if (good(r)) return r;
        }
        return -1;
    }

    const TriangleMesh& mesh_;
    const std::vector<Region>& regions_;
    const std::vector<QuantisedQuadric>& own_;
    double limit_;
    std::vector<char> alive_;
    Patches patches_;
};

}  // namespace

Patches assign_patches(const TriangleMesh& mesh, const std::vector<Region>& regions,
                       const std::vector<QuantisedQuadric>& own, double limit) {
    return Assignment(mesh, regions, own, limit).run();
}

}  // namespace pfgeom
