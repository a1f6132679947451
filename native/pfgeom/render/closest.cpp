#include "pfgeom/render/closest.h"

#include "pfgeom/base/parallel.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Points a chunk, and between two reports of progress: some milliseconds, and some hundred.
constexpr std::size_t kChunk = 64, kBlock = 64 * kChunk;

}  // namespace

std::vector<NearestPoint> closest_points(const RayScene& scene, std::span<const Vec3> points, double accuracy,
                                         const Task& task) {
    std::vector<NearestPoint> found(points.size());
    for (std::size_t first = 0; first < points.size(); first += kBlock) {
        const std::size_t count = std::min(kBlock, points.size() - first);
        parallel_chunks(count, kChunk, task, [&](std::size_t begin, std::size_t end) {
            ExtremeSearch search(task);
            for (std::size_t i = first + begin; i < first + end; ++i) {
                if (is_finite(points[i])) found[i] = scene.nearest(points[i], accuracy, search);
            }
        });
        task.report(static_cast<double>(first + count) / static_cast<double>(points.size()), "searching");
    }
    return found;
}

}  // namespace pfgeom
