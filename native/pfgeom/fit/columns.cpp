#include "pfgeom/fit/columns.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/eval/ball_grid.h"

namespace pfgeom {
namespace {

constexpr double kLeastEnergy = 0.02;  // of the mean

struct Hit {
    std::int32_t ball;
    Columns::Entry entry;
};

}  // namespace

Columns make_columns(const Level& level, const LevelSamples& samples, const Task& task) {
    constexpr std::size_t kChunk = 2048;
    const std::size_t n = level.centres.size();
    const BallGrid grid(level.centres, level.radius);
    std::vector<std::vector<Hit>> hits((samples.points.size() + kChunk - 1) / kChunk);
    parallel_chunks(samples.points.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
        auto& list = hits[begin / kChunk];
        for (std::size_t s = begin; s < end; ++s) {
            grid.near(samples.points[s], [&](std::int32_t ball, double q, const Vec3&) {
                const double unit = level.step * level.scale[static_cast<std::size_t>(ball)];
                const auto slope = static_cast<float>(samples.weights[s] * (q * q * q) * unit);
                list.push_back({ball, {static_cast<std::int32_t>(s), slope}});
            });
        }
    });
    Columns c;
    c.first.assign(n + 1, 0);
    for (const auto& list : hits) {
        for (const Hit& hit : list) ++c.first[static_cast<std::size_t>(hit.ball) + 1];
    }
    for (std::size_t i = 0; i < n; ++i) c.first[i + 1] += c.first[i];
    c.entries.resize(c.first.back());
    std::vector<std::uint32_t> at(c.first.begin(), c.first.end() - 1);
    for (auto& list : hits) {
        for (const Hit& hit : list) c.entries[at[static_cast<std::size_t>(hit.ball)]++] = hit.entry;
        std::vector<Hit>().swap(list);
    }
    c.energy.assign(n, 0);
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::uint32_t k = c.first[i]; k < c.first[i + 1]; ++k) {
            const double a = c.entries[k].slope;
            c.energy[i] += a * a;
        }
        mean += c.energy[i] / static_cast<double>(n);
    }
    for (double& e : c.energy) {
        if (e < kLeastEnergy * mean) e = 0;
    }
    return c;
}

}  // namespace pfgeom
