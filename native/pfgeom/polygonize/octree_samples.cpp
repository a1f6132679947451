// The field at the corners of the octree's cells: each corner is evaluated once, many at a time.
#include "pfgeom/polygonize/octree.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr std::size_t kBatch = 1 << 15;  // cells: what is only needed for a while stays small

}  // namespace

double Octree::value(const LatticePoint& p) const {
    const std::int32_t row = samples_.find(p);
    return row < 0 ? field_.value(p) : samples_.value(row);
}

// Of cells that stay as they are.
void Octree::sample_corners(std::span<const std::int32_t> cells) {
    for (std::size_t i = 0; i < cells.size(); i += kBatch)
        sample_corners(cells.subspan(i, std::min(kBatch, cells.size() - i)), false);
}

// Rows of the cells' corners among the samples.
std::vector<Octree::Corners> Octree::sample_corners(std::span<const std::int32_t> cells, bool with_normals) {
    const std::size_t first = samples_.size();
    std::vector<Corners> corners(cells.size());
    std::vector<NewSample> added;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i % 1024 == 0) task_.check();
        const OctreeNode& node = nodes_[cells[i]];
        for (int k = 0; k < 8; ++k) {
            const LatticePoint p = cube_corner(node.corner, size_at(node.depth), k);
            corners[i][k] = samples_.find_or_add(p);
            if (samples_.size() > first + added.size()) added.push_back({p, node.block});
        }
    }
    if (with_normals) samples_.add_normals();
    parallel_chunks(added.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for_runs(
            begin, end, [&](std::size_t i) { return added[i].block; },
            [&](std::size_t from, std::size_t to) {
                evaluate(std::span(added).subspan(from, to - from), first + from, with_normals);
            });
    });
    for (std::size_t i = 0; i < cells.size(); ++i) {
        OctreeNode& node = nodes_[cells[i]];
        node.inside = 0;
        for (int k = 0; k < 8; ++k)
            if (samples_.value(corners[i][k]) >= 0) node.inside |= static_cast<std::uint8_t>(1 << k);
        if (!node.mixed()) continue;
        node.corners = static_cast<std::int32_t>(corners_.size());
        corners_.push_back(corners[i]);
    }
    return corners;
}

// Samples in a row that are of one block; `first` is the row of the first.
void Octree::evaluate(std::span<const NewSample> added, std::size_t first, bool with_normals) {
    const CubeField local = field(added.front().block);
    std::array<Vec3, kChunk> points, gradients;
    std::array<double, kChunk> values;
    for (std::size_t i = 0; i < added.size(); ++i) points[i] = local.position(added[i].point);
    const std::span<const Vec3> used = std::span(points).first(added.size());
    if (with_normals)
        local.values_and_gradients(used, values, gradients);
    else
        local.values(used, values);
    for (std::size_t i = 0; i < added.size(); ++i) {
        const double value = local.lattice_value(added[i].point, values[i]);
        if (with_normals)
            samples_.set(first + i, value, Samples::normal_of(gradients[i]));
        else
            samples_.set(first + i, value);
    }
}

}  // namespace pfgeom
