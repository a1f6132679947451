#include "pfgeom/fit/missed_points.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/fit/foot_point.h"
#include "pfgeom/mesh/bvh.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Each curved face is looked for as so many flat ones along a side: a chord is off by a sixteenth of a bulge,
// which the foot point on the curved one makes good.
constexpr int kParts = 4;
// The smallest parts of faces that are looked at, as shares of the limit. Around a point that is missed,
// which stands for its neighbours, they are larger, also as shares of the face's longest edge.
constexpr double kFinest = 0.02, kAroundMissed = 0.5, kPartAroundMissed = 1.0 / 64;

constexpr std::size_t kChunk = 64;  // faces

using Corners = std::array<Vec3, 3>;

class Surface {
  public:
    Surface(const CollapseMesh& mesh, double limit, const Task& task)
        : mesh_(mesh),
          limit_(limit),
          left_(mesh.faces_left()),
          bvh_(mesh.curved() ? divided() : mesh.result(), task) {}

    // From p, a point of the original's face `origin`; measured out if it is beyond the limit.
    MissedPoint closest(const Vec3& p, std::int32_t origin, std::int32_t& hint) const {
        const ClosestPoint found = bvh_.closest(p, std::numeric_limits<double>::infinity(), hint);
        hint = found.face;
        const int parts = mesh_.curved() ? kParts * kParts : 1;
        const std::size_t row = static_cast<std::size_t>(found.face / parts);
        MissedPoint result{p, origin, left_[row], found.squared_distance};
        if (mesh_.curved() && result.squared > limit_ * limit_)
            result.squared = std::min(result.squared, foot_point(p, curved(row)).squared);
        return result;
    }
    double limit() const { return limit_; }

    // Is all of the part within the limit of one face, as closest() gives it in `hint`?
    bool within_limit_of(std::int32_t hint, const Corners& part) const {
        if (!mesh_.curved()) return bvh_.farthest_corner(part, hint) <= limit_;
        return within_limit_of(curved(static_cast<std::size_t>(hint / (kParts * kParts))), part);
    }

  private:
    CurvedTriangle curved(std::size_t row) const {
        const std::int32_t f = left_[row];
        return {mesh_.corners(f), {mesh_.bulge(f, 0), mesh_.bulge(f, 1), mesh_.bulge(f, 2)}};
    }

    // From each point of the part to that of the face whose weights are mixed alike from the corners' foot
    // points: a quadratic Bézier triangle of vectors, none of which is longer than the longest of its control
    // points.
    bool within_limit_of(const CurvedTriangle& face, const Corners& part) const {
        const double most = limit_ * limit_;
        Corners off, weights;
        for (std::size_t k = 0; k < 3; ++k) {
            const FootPoint foot = foot_point(part[k], face);
            if (foot.squared > most) return false;
            off[k] = part[k] - foot.point;
            weights[k] = foot.weights;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const Vec3 side = (off[k] + off[next] + face.bend(weights[k] - weights[next])) * 0.5;
            if (squared_norm(side) > most) return false;
        }
        return true;
    }

    // kParts² faces of each curved one, in its place.
    TriangleMesh divided() const {
        TriangleMesh result;
        for (std::size_t row = 0; row < left_.size(); ++row) {
            const CurvedTriangle whole = curved(row);
            const auto add = [&](int i, int j) {
                const double v = static_cast<double>(i) / kParts, w = static_cast<double>(j) / kParts;
                result.vertices.push_back(whole.at({1 - v - w, v, w}));
                return static_cast<std::int32_t>(result.vertices.size()) - 1;
            };
            for (int i = 0; i < kParts; ++i) {
                for (int j = 0; i + j < kParts; ++j) {
                    result.faces.push_back({add(i, j), add(i + 1, j), add(i, j + 1)});
                    if (i + j + 1 < kParts)
                        result.faces.push_back({add(i + 1, j), add(i + 1, j + 1), add(i, j + 1)});
                }
            }
        }
        return result;
    }

    const CollapseMesh& mesh_;
    double limit_;
    std::vector<std::int32_t> left_;
    Bvh bvh_;
};

class Search {
  public:
    explicit Search(const Surface& surface) : surface_(surface), limit_(surface.limit()) {}

    void look_along(const Corners& face, std::int32_t origin, std::vector<MissedPoint>& missed) {
        const double longest = std::sqrt(longest_squared(face)), finest = kFinest * limit_;
        const double around = std::max(kAroundMissed * limit_, kPartAroundMissed * longest);
        open_.assign({face});
        while (!open_.empty()) {
            const auto [a, b, c] = open_.back();
            open_.pop_back();
            const Vec3 middle = (a + b + c) / 3;
            const MissedPoint found = surface_.closest(middle, origin, hint_);
            const double distance = std::sqrt(found.squared);
            const double reach = std::sqrt(
                std::max({squared_norm(a - middle), squared_norm(b - middle), squared_norm(c - middle)}));
            if (distance > limit_) {
                missed.push_back(found);
                if (reach < around) continue;
            }
            if (reach < finest || distance + reach <= limit_) continue;
            if (surface_.within_limit_of(hint_, {a, b, c})) continue;
            const Vec3 ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
            open_.insert(open_.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
    }

  private:
    const Surface& surface_;
    double limit_;
    std::int32_t hint_ = -1;
    std::vector<Corners> open_;
};

}  // namespace

std::vector<MissedPoint> missed_points(const TriangleMesh& original, const CollapseMesh& mesh, double limit,
                                       const Task& task) {
    const Surface surface(mesh, limit, task);
    std::vector<std::vector<MissedPoint>> of_chunks((original.faces.size() + kChunk - 1) / kChunk);
    parallel_chunks(original.faces.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
        Search search(surface);
        for (std::size_t f = begin; f < end; ++f) {
            Corners corners;
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = original.vertices[static_cast<std::size_t>(original.faces[f][k])];
            search.look_along(corners, static_cast<std::int32_t>(f), of_chunks[begin / kChunk]);
        }
    });
    std::vector<MissedPoint> missed;
    for (const std::vector<MissedPoint>& found : of_chunks)
        missed.insert(missed.end(), found.begin(), found.end());
    return missed;
}

}  // namespace pfgeom
