#include "pfgeom/eval/surroundings.h"

#include "pfgeom/base/parallel.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr std::size_t kMostNeighbours = 8;
// Σ q² over the balls of a full level around a point of the surface: π r² / 3 balls' area over 0.5 h².
constexpr double kMeanCover = 6;

std::int32_t sixteenths(double x) {
    return static_cast<std::int32_t>(std::floor(std::clamp(x * 16, -1e6, 1e6) + 0.5));
}

// Earlier centres within the support's radius, by a grid of points.
class EarlierNeighbours {
  public:
    explicit EarlierNeighbours(const Level& level) : level_(level), inverse_(1 / level.radius) {
        next_.resize(level.centres.size());
        for (std::size_t i = 0; i < level.centres.size(); ++i) {
            std::int32_t& head = first_[CellIndex::of(level.centres[i], inverse_).key()];
            next_[i] = head;
            head = static_cast<std::int32_t>(i);
        }
    }
    struct Near {
        double d2;
        std::int32_t index;
    };
    // Appends to `out`, nearest first, ties by index; `near` is scratch.
    void find(std::size_t i, std::vector<Near>& near, std::vector<Neighbour>& out) const {
        near.clear();
        const Vec3& p = level_.centres[i];
        const CellIndex at = CellIndex::of(p, inverse_);
        for (int t = 0; t < 27; ++t) {
            const CellIndex cell{at.x + t / 9 - 1, at.y + t / 3 % 3 - 1, at.z + t % 3 - 1};
            for (std::int32_t j = first_.find(cell.key()); j >= 0; j = next_[static_cast<std::size_t>(j)]) {
                if (j >= static_cast<std::int32_t>(i)) continue;
                const double d2 = squared_norm(level_.centres[static_cast<std::size_t>(j)] - p);
                if (d2 < level_.radius * level_.radius) near.push_back({d2, j});
            }
        }
        const std::size_t count = std::min(near.size(), kMostNeighbours);
        std::partial_sort(
            near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(),
            [](const Near& a, const Near& b) { return a.d2 != b.d2 ? a.d2 < b.d2 : a.index < b.index; });
        const double h = std::ldexp(2.0, -level_.depth);
        for (std::size_t k = 0; k < count; ++k) {
            const double d2 = near[k].d2 / (h * h);
            out.push_back({near[k].index, static_cast<std::int32_t>(256 / (0.3 + d2))});
        }
    }

  private:
    const Level& level_;
    double inverse_;
    CellTable first_;
    std::vector<std::int32_t> next_;
};

struct Around {
    double magnitude = 0, sum = 0;
};

Around around(const LevelField& level, const Vec3& p) {
    Around a;
    level.grid().near(p, [&](std::int32_t ball, double q, const Vec3&) {
        const double f = level.factor(ball);
        a.magnitude += q * q * std::abs(f);
        a.sum += q * q * q * f;
    });
    a.magnitude /= kMeanCover;
    return a;
}

}  // namespace

Surroundings survey(const FunctionField& field, const Level& level, const Task& task) {
    constexpr std::size_t kChunk = 1024;
    const std::size_t n = level.centres.size();
    Surroundings s;
    for (auto* v : {&s.parent, &s.grandparent, &s.parent_sum, &s.grandparent_sum, &s.bend, &s.value})
        v->assign(n, 0);
    const EarlierNeighbours earlier(level);
    std::vector<std::vector<Neighbour>> lists((n + kChunk - 1) / kChunk);
    std::vector<std::uint32_t> counts(n);
    const double h = std::ldexp(2.0, -level.depth);
    const std::size_t depth = field.level_count();
    parallel_chunks(n, kChunk, task, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour>& list = lists[begin / kChunk];
        std::vector<EarlierNeighbours::Near> scratch;
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t before = list.size();
            earlier.find(i, scratch, list);
            counts[i] = static_cast<std::uint32_t>(list.size() - before);
            const Vec3& p = level.centres[i];
            const double unit = level.step * level.scale[i];
            if (depth >= 1) {
                const Around a = around(field.level(depth - 1), p);
                s.parent[i] = sixteenths(a.magnitude / unit);
                s.parent_sum[i] = sixteenths(a.sum / unit);
            }
            if (depth >= 2) {
                const Around a = around(field.level(depth - 2), p);
                s.grandparent[i] = sixteenths(a.magnitude / unit);
                s.grandparent_sum[i] = sixteenths(a.sum / unit);
            }
            s.bend[i] = sixteenths(field.curvature(p) * h * h / 8 / unit);
            if (level.lattice[i] != 0) s.value[i] = sixteenths(field.value(p) / h);
        }
    });
    s.first.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) s.first[i + 1] = s.first[i] + counts[i];
    s.neighbours.reserve(s.first.back());
    for (const auto& list : lists) s.neighbours.insert(s.neighbours.end(), list.begin(), list.end());
    return s;
}

}  // namespace pfgeom
