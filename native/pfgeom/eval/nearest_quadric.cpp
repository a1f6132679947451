#include "pfgeom/eval/nearest_quadric.h"

#include "pfgeom/base/parallel.h"

#include <array>
#include <limits>

namespace pfgeom {
namespace {

// As in tree_field.cpp: near an axis or an apex the first-order distance is none.
constexpr double kLeastSlope = 0.25;
constexpr std::size_t kChunk = 256;

double squared_distance(const Quadric& q, const Vec3& p) {
    const double value = q.value(p);
    return value * value / std::max(squared_norm(q.gradient(p)), kLeastSlope * kLeastSlope);
}

std::int32_t nearest(const SetTree& tree, const std::array<Vec3, 4>& points) {
    std::int32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t q = 0; q < tree.quadrics.size(); ++q) {
        double sum = 0;
        for (std::size_t i = 0; i < points.size() && sum < least; ++i)
            sum += squared_distance(tree.quadrics[q].quadric, points[i]);
        if (sum >= least) continue;
        least = sum;
        best = static_cast<std::int32_t>(q);
    }
    return best;
}

}  // namespace

std::vector<std::int32_t> nearest_quadrics(const SetTree& tree, const Frame& frame, const TriangleMesh& mesh,
                                           const Task& task) {
    std::vector<std::int32_t> result(mesh.faces.size());
    parallel_chunks(result.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            std::array<Vec3, 4> points;
            for (std::size_t i = 0; i < 3; ++i)
                points[i] = frame.to_local(mesh.vertices[static_cast<std::size_t>(mesh.faces[f][i])]);
            points[3] = (points[0] + points[1] + points[2]) / 3;
            result[f] = nearest(tree, points);
        }
    });
    return result;
}

}  // namespace pfgeom
