#include "pfgeom/fit/bulge_grid.h"

#include "pfgeom/eval/edge_axes.h"
#include "pfgeom/fit/patch_loop.h"
#include "pfgeom/function/edges_of_faces.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pfgeom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kRounds = 3;
// Bulges that are tried, in steps along the normal and sideways from the rounded one: the best of those along
// the normal; if none keeps the limit, until one does.
constexpr std::array<std::int32_t, 3> kStraight{0, 1, -1};
constexpr std::array<std::array<std::int32_t, 2>, 9> kOthers{
    {{2, 0}, {-2, 0}, {0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}}};

class BulgeSnapper {
  public:
    BulgeSnapper(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits, const Frame& frame,
                 MeshPart& part, bool settled)
        : mesh_(mesh),
          error_(error),
          limits_(limits),
          part_(part),
          settled_(settled),
          edges_(EdgesOfFaces::of(part.faces)),
          axes_(edge_axes(part, edges_)),
          faces_at_(edges_.ends.size()),
          step_(part.bulge_step() * frame.half()) {
        const std::vector<std::int32_t> left = mesh.faces_left();
        for (std::size_t f = 0; f < left.size(); ++f) {
            for (std::size_t k = 0; k < 3; ++k)
                faces_at_[static_cast<std::size_t>(edges_.of_face[f][k])].push_back({left[f], k});
        }
        part_.bulges.assign(edges_.ends.size(), {});
    }

    std::vector<EdgeEnds> run(const Task& task) {
        std::vector<std::size_t> open(faces_at_.size());
        std::iota(open.begin(), open.end(), std::size_t{0});
        for (int round = 0; round < kRounds && !open.empty(); ++round) open = failed(open, task);
        std::vector<EdgeEnds> ends;
        for (const std::size_t row : open) {
            const auto& [face, k] = faces_at_[row][0];
            ends.push_back({mesh_.face(face)[k], mesh_.face(face)[(k + 1) % 3]});
        }
        return ends;
    }

  private:
    struct Side {
        std::int32_t face;
        std::size_t k;
    };
    // Snaps these edges; returns those that fail.
    std::vector<std::size_t> failed(const std::vector<std::size_t>& open, const Task& task) {
        PatchLoop loop(mesh_, error_);
        for (const std::size_t row : open) {
            std::vector<std::int32_t> faces;
            for (const Side& side : faces_at_[row]) faces.push_back(side.face);
            loop.add(faces);
        }
        std::vector<std::uint8_t> fails(open.size(), 0);
        loop.run(task, [&](std::size_t i) { fails[i] = snap(open[i], limit(open.size() - i)) ? 0 : 1; });
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (fails[i] != 0) result.push_back(open[i]);
        }
        return result;
    }
    Vec3 vector_of(std::size_t row, const Bulge& b) const {
        return (axes_[row].normal * b.normal + axes_[row].sideways * b.sideways) * step_;
    }
    Patch with_bulge(std::size_t row, const Vec3& bulge) const {
        Patch patch;
        for (const Side& side : faces_at_[row]) {
            patch.before.push_back(side.face);
            const auto t = mesh_.corners(side.face);
            const std::size_t i = side.k, j = (i + 1) % 3, k = (i + 2) % 3;
            patch.triangles.push_back({t[i], t[j], t[k]});
            patch.bulges.push_back({bulge, mesh_.bulge(side.face, j), mesh_.bulge(side.face, k)});
            patch.ends.push_back({mesh_.face(side.face)[j], mesh_.face(side.face)[k]});
        }
        patch.after = patch.before;
        return patch;
    }
    // What an edge's bulge may cost, in the unit of CollapseError::forward(): for the rms an even share of
    // what the sum may still rise.
    double limit(std::size_t left) const {
        if (limits_.metric == Metric::max) return limits_.forward;
        const double rise = limits_.forward * limits_.forward - error_.mean_square();
        return rise * error_.total_weight() / static_cast<double>(left);
    }
    double cost(std::size_t row, const Bulge& b, double most) const {
        const Patch patch = with_bulge(row, vector_of(row, b));
        const double forward = error_.forward(patch, most);
        if (!(forward < most)) return kInfinity;
        if (limits_.metric == Metric::rms)
            return error_.stays_near(patch, limits_.backward) ? forward : kInfinity;
        return std::max(forward, error_.backward(patch, most, forward));
    }
    bool snap(std::size_t row, double limit) {
        const EdgeAxes& axes = axes_[row];
        const Vec3 now = mesh_.bulge(faces_at_[row][0].face, faces_at_[row][0].k);
        const auto steps = [&](const Vec3& axis) {
            return static_cast<std::int32_t>(std::floor(dot(now, axis) / step_ + 0.5));
        };
        const bool seam = part_.is_seam(edges_.ends[row]);  // stays on the mirror's plane
        const Bulge rounded{steps(axes.normal), seam ? 0 : steps(axes.sideways)};
        Bulge best{rounded.normal, 0};
        double least = kInfinity;
        const auto try_bulge = [&](const Bulge& b) {
            const double c = cost(row, b, least);
            if (!(c < least)) return;
            least = c;
            best = b;
        };
        if (settled_) try_bulge(rounded);
        const bool stays = settled_ && least <= limit;
        for (std::size_t i = 0; i < kStraight.size() && !stays; ++i)
            try_bulge({rounded.normal + kStraight[i], 0});
        // Creases and borders need it; and where the faces have turned since a bulge was found, it leans.
        for (std::size_t i = 0; i < kOthers.size() && least > limit; ++i) {
            if (!seam || kOthers[i][1] == 0)
                try_bulge({rounded.normal + kOthers[i][0], rounded.sideways + kOthers[i][1]});
        }
        part_.bulges[row] = best;
        error_.commit(with_bulge(row, vector_of(row, best)));
        for (const Side& side : faces_at_[row]) mesh_.set_bulge(side.face, side.k, vector_of(row, best));
        return least <= limit;
    }

    CollapseMesh& mesh_;
    CollapseError& error_;
    const CollapseLimits& limits_;
    MeshPart& part_;
    bool settled_;
    EdgesOfFaces edges_;
    std::vector<EdgeAxes> axes_;
    std::vector<std::vector<Side>> faces_at_;  // of each edge
    double step_;
};

}  // namespace

std::vector<EdgeEnds> snap_bulges(CollapseMesh& mesh, CollapseError& error, const CollapseLimits& limits,
                                  const Frame& frame, MeshPart& part, bool settled, const Task& task) {
    return BulgeSnapper(mesh, error, limits, frame, part, settled).run(task);
}

}  // namespace pfgeom
