#include "pfgeom/segment/copies.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/segment/laid_on.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfgeom {
namespace {

// A mesh of fewer faces takes no more bytes than a placement.
constexpr std::size_t kLeastFaces = 12;
// Moments are compared up to so many tolerances over the size, and rounding. An area changes by twice a
// relative shift of the surface, its second moments by four times that.
constexpr double kMomentShifts = 8, kMomentRounding = 1e-5, kMostDifferent = 0.1;
// An island that could not be laid on so many is one by itself: shapes that differ by less than their moments
// show come in numbers too.
constexpr int kMostVain = 8;
constexpr std::size_t kTogether = 32;  // laid on in parallel

class CopyFinder {
  public:
    CopyFinder(const PreparedMesh& prepared, double tolerance, const Task& task)
        : prepared_(prepared), tolerance_(tolerance), task_(task) {}

    std::vector<CopyGroup> run() {
        measure();
        std::vector<CopyGroup> groups;
        for (const std::size_t i : by_size_) {
            task_.check();
            if (taken_[i]) continue;
            CopyGroup group = copies_of(i);
            if (group.size() > 1) groups.push_back(std::move(group));
        }
        return groups;
    }

  private:
    void measure() {
        const std::size_t n = prepared_.islands.size();
        moments_.resize(n);
        taken_.assign(n, 0);
        vain_.assign(n, 0);
        parallel_chunks(n, 16, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (may_repeat(prepared_.islands[i])) moments_[i] = moments_of(mesh_of(i));
            }
        });
        for (std::size_t i = 0; i < n; ++i) {
            if (moments_[i].area > 0) by_size_.push_back(i);
        }
        by_shape_ = by_size_;
        const auto larger = [&](std::size_t a, std::size_t b) { return moments_[a].area > moments_[b].area; };
        std::stable_sort(by_size_.begin(), by_size_.end(), larger);
        const auto rounder = [&](std::size_t a, std::size_t b) { return shape(a) < shape(b); };
        std::stable_sort(by_shape_.begin(), by_shape_.end(), rounder);
    }

    static bool may_repeat(const Island& island) {
        return island.faces.size() >= kLeastFaces && !(island.signed_volume < 0 && island.parent >= 0);
    }

    TriangleMesh mesh_of(std::size_t i) const { return extract_island(prepared_, prepared_.islands[i]); }

    double shape(std::size_t i) const { return moments_[i].shape(2); }  // the largest moment

    CopyGroup copies_of(std::size_t first) {
        taken_[first] = 1;
        CopyGroup group{{first, {}}};
        const std::vector<std::size_t> alike = islands_like(first);
        if (alike.empty()) return group;
        const Pattern pattern(mesh_of(first));
        for (std::size_t from = 0; from < alike.size(); from += kTogether) {
            const std::size_t count = std::min(kTogether, alike.size() - from);
            std::vector<std::optional<Similarity>> places(count);
            parallel_chunks(count, 1, task_, [&](std::size_t k, std::size_t) {
                const std::size_t i = alike[from + k];
                places[k] = pattern.laid_on(mesh_of(i), moments_[i], tolerance_, task_);
            });
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t i = alike[from + k];
                if (places[k]) group.push_back({i, *places[k]});
                (places[k] ? taken_[i] : vain_[i]) += 1;
            }
        }
        return group;
    }

    // Those left whose moments are the first's.
    std::vector<std::size_t> islands_like(std::size_t first) const {
        const double slack = std::min(
            kMostDifferent, kMomentRounding + kMomentShifts * tolerance_ / std::sqrt(moments_[first].area));
        const double middle = shape(first);
        auto at = std::lower_bound(by_shape_.begin(), by_shape_.end(), middle * (1 - slack),
                                   [&](std::size_t i, double value) { return shape(i) < value; });
        std::vector<std::size_t> alike;
        for (; at != by_shape_.end() && shape(*at) <= middle * (1 + slack); ++at) {
            if (!taken_[*at] && vain_[*at] < kMostVain && is_alike(first, *at, slack)) alike.push_back(*at);
        }
        std::sort(alike.begin(), alike.end());
        return alike;
    }

    bool is_alike(std::size_t a, std::size_t b, double slack) const {
        const Island &one = prepared_.islands[a], &other = prepared_.islands[b];
        if (one.closed != other.closed || one.oriented != other.oriented) return false;
        const SurfaceMoments &m = moments_[a], &n = moments_[b];
        for (const int i : {0, 1}) {
            if (std::abs(m.shape(i) - n.shape(i)) > slack * m.shape(2)) return false;
        }
        if (!one.closed) return true;
        // Volume over area^(3/2), with its sign: an inside-out copy is none.
        const double v = m.volume / (m.area * std::sqrt(m.area)), w = n.volume / (n.area * std::sqrt(n.area));
        return std::abs(v - w) <= slack * 0.1;
    }

    const PreparedMesh& prepared_;
    double tolerance_;
    const Task& task_;
    std::vector<SurfaceMoments> moments_;
    std::vector<std::size_t> by_size_, by_shape_;
    std::vector<int> taken_, vain_;
};

}  // namespace

std::vector<CopyGroup> find_copies(const PreparedMesh& prepared, double tolerance, const Task& task) {
    return CopyFinder(prepared, tolerance, task).run();
}

}  // namespace pfgeom
