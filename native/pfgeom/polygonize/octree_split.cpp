// Cells get children, and those that the surface cannot cross are told from the others: a tangent of the
// field at the middle of a parent, with its error, says most of it.
#include "pfgeom/base/grow.h"
#include "pfgeom/polygonize/octree.h"

#include <algorithm>
#include <string>

namespace pfgeom {
namespace {

constexpr std::size_t kMostCells = 2'000'000'000;  // rows are 32 bit

// Depth of the cells within which the field is pruned. On igea's hierarchy in cells of 1/1024 depths of 5, 6,
// 7 take 4.7, 4.1, 4.4 CPU s and 0.89, 0.87, 1.06 GB; in cells of 1/256 0.7, 0.8, 1.5 s and 0.12, 0.18, 0.37
// GB.
constexpr int kBlockDepth = 6;
// A parent's tangent serves its children if it is off by no more than this share of what its slope makes. (In
// blocks of a uniform grid it always does: there a cell too many costs some samples, or a tangent of its
// own.)
constexpr double kFlat = 0.25;

}  // namespace

// Gives the parents children; returns those that the surface can cross.
std::vector<std::int32_t> Octree::split(std::vector<std::int32_t> parents) {
    add_blocks(parents);
    std::vector<Tangent> tangents = tangents_in(parents);
    if (uniform()) keep_crossed(parents, tangents);
    const std::size_t first = nodes_.size(), total = first + 8 * parents.size();
    if (total > std::min(options_.max_cells, kMostCells))
        throw LimitExceeded("polygonize: more than max_cells = " + std::to_string(options_.max_cells) +
                            " cells");
    grow(nodes_, total, task_);
    parallel_chunks(parents.size(), kFamilies, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            add_children(nodes_[parents[i]], static_cast<std::int32_t>(first + 8 * i), tangents[i]);
    });
    std::vector<std::int32_t> survivors;
    for (std::size_t i = first; i < total; ++i) {
        if (i % 1024 == 0) task_.check();
        deepest_ = std::max<int>(deepest_, nodes_[i].depth);
        if (nodes_[i].may_cross) survivors.push_back(static_cast<std::int32_t>(i));
    }
    return survivors;
}

std::vector<Tangent> Octree::tangents_in(const std::vector<std::int32_t>& cells) const {
    std::vector<Tangent> tangents(cells.size());
    parallel_chunks(cells.size(), kFamilies, task_, [&](std::size_t begin, std::size_t end) {
        for_runs(
            begin, end, [&](std::size_t i) { return nodes_[cells[i]].block; },
            [&](std::size_t from, std::size_t to) {
                std::array<Box, kFamilies> boxes;
                for (std::size_t i = from; i < to; ++i)
                    boxes[i - from] = field_.box(nodes_[cells[i]].corner, size_at(nodes_[cells[i]].depth));
                field(nodes_[cells[from]].block)
                    .tangents(std::span(boxes).first(to - from), std::span(tangents).subspan(from));
            });
    });
    return tangents;
}

// Cells, and their tangents, in which the surface can be. A block without it is not needed any more.
void Octree::keep_crossed(std::vector<std::int32_t>& cells, std::vector<Tangent>& tangents) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        OctreeNode& node = nodes_[cells[i]];
        const double half = size_at(node.depth) * field_.step() / 2;
        if (field_.may_cross(node.corner, size_at(node.depth), tangents[i].over({}, {half, half, half}))) {
            cells[kept] = cells[i];
            tangents[kept++] = tangents[i];
        } else if (node.depth == kBlockDepth && node.block >= 0) {
            blocks_[static_cast<std::size_t>(node.block)].reset();
            node.block = -1;
        }
    }
    cells.resize(kept);
    tangents.resize(kept);
}

void Octree::add_children(OctreeNode& parent, std::int32_t first, const Tangent& tangent) {
    parent.children = first;
    const CubeField local = field(parent.block);
    const std::int32_t size = size_at(parent.depth + 1);
    const double half = size * local.step() / 2;
    const Vec3 extent{half, half, half};
    const Vec3& g = tangent.gradient;
    const bool serves = (uniform() && parent.block >= 0) ||
                        tangent.error <= kFlat * half * (std::abs(g.x) + std::abs(g.y) + std::abs(g.z));
    for (int k = 0; k < 8; ++k) {
        OctreeNode& child = nodes_[first + k];
        child.depth = static_cast<std::uint8_t>(parent.depth + 1);
        child.block = parent.block;
        child.corner = cube_corner(parent.corner, size, k);
        const Vec3 offset{k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half};
        child.may_cross = serves ? local.may_cross(child.corner, size, tangent.over(offset, extent))
                                 : local.may_cross(child.corner, size);
    }
}

// Of the cells, those in which the field is pruned.
void Octree::add_blocks(const std::vector<std::int32_t>& cells) {
    std::vector<std::int32_t> chosen;
    for (const std::int32_t cell : cells)
        if (nodes_[cell].depth == kBlockDepth) chosen.push_back(cell);
    const std::size_t first = blocks_.size();
    blocks_.resize(first + chosen.size());
    parallel_chunks(chosen.size(), kFamilies, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            OctreeNode& node = nodes_[chosen[i]];
            blocks_[first + i] = field_.pruned(node.corner, size_at(node.depth));
            if (blocks_[first + i]) node.block = static_cast<std::int32_t>(first + i);
        }
    });
}

}  // namespace pfgeom
