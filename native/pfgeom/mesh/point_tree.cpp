#include "pfgeom/mesh/point_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pfgeom {
namespace {

constexpr std::int32_t kLeafPoints = 8;

/// Whether the segment from a meets the box grown by `distance` (by slabs).
bool meets(const Box& box, double distance, const Vec3& a, const Vec3& direction) {
    double t0 = 0, t1 = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = box.lo[axis] - distance - a[axis], hi = box.hi[axis] + distance - a[axis];
        if (direction[axis] == 0) {
            if (lo > 0 || hi < 0) return false;
            continue;
        }
        const double u = lo / direction[axis], v = hi / direction[axis];
        t0 = std::max(t0, std::min(u, v));
        t1 = std::min(t1, std::max(u, v));
    }
    return t0 <= t1;
}

}  // namespace

double nearest_parameter(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 direction = b - a;
    const double length2 = squared_norm(direction);
    return length2 > 0 ? std::clamp(dot(p - a, direction) / length2, 0.0, 1.0) : 0.0;
}

PointTree::PointTree(std::vector<Vec3> points) : points_(std::move(points)), order_(points_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!points_.empty()) build(0, static_cast<std::int32_t>(points_.size()));
}

void PointTree::build(std::int32_t begin, std::int32_t end) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({{}, begin, end, -1});
    Box box;
    for (std::int32_t i = begin; i < end; ++i) box.grow(points_[order_[i]]);
    nodes_[node].box = box;
    if (end - begin <= kLeafPoints) return;

    const Vec3 extent = box.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::int32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::int32_t i, std::int32_t j) {
                         const double x = points_[i][axis], y = points_[j][axis];
                         return x != y ? x < y : i < j;
                     });
    build(begin, middle);
    nodes_[node].right = static_cast<std::int32_t>(nodes_.size());
    build(middle, end);
}

void PointTree::near_segment(const Vec3& a, const Vec3& b, double distance,
                             std::vector<std::int32_t>& rows) const {
    rows.clear();
    const Vec3 direction = b - a;
    std::vector<std::int32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const std::int32_t at = open.back();
        open.pop_back();
        const Node& node = nodes_[at];
        if (!meets(node.box, distance, a, direction)) continue;
        if (node.right >= 0) {
            open.push_back(node.right);
            open.push_back(at + 1);
            continue;
        }
        for (std::int32_t i = node.begin; i < node.end; ++i) {
            const Vec3& p = points_[order_[i]];
            const Vec3 nearest = a + direction * nearest_parameter(p, a, b);
            if (squared_norm(p - nearest) <= distance * distance) rows.push_back(order_[i]);
        }
    }
}

}  // namespace pfgeom
