// Refinement of the octree. A cell is split where the unit gradients at its eight corners and its centre say
// that a mesh with edges of its size would leave the chord tolerance, or that the cell may hold more than one
// sheet.
//
// Sources: range test of cells, J. M. Snyder, "Interval analysis for computer graphics", SIGGRAPH 1992;
// Hermite data for the error of a cell, T. Ju et al., "Dual contouring of Hermite data", SIGGRAPH 2002.
// Departure: no least-squares vertex is solved for; the change of normals times the distance estimates the
// error.
#include "pfgeom/polygonize/octree.h"

#include <algorithm>
#include <string>

namespace pfgeom {
namespace {

constexpr std::size_t kChunk = 128;  // cells or points a job: some 0.2 ms, and cancel polls between jobs

constexpr std::size_t kMostCells = 2'000'000'000;  // rows are 32 bit

// Depth of the cells within which the field is pruned. On igea's hierarchy in cells of 1/1024 depths of 5, 6,
// 7 take 11.7, 10.7, 10.4 s and 1.28, 1.31, 1.59 GB; in cells of 1/256 1.2, 1.3, 1.9 s and 0.16, 0.23, 0.50
// GB.
constexpr int kBlockDepth = 6;
// A parent's tangent serves its children if it is off by no more than this share of what its slope makes.
constexpr double kFlat = 0.25;

// Normals further apart than 60° within half a cell: its surface is no height field, and in a cell without a
// change of sign a small sheet may hide (a closed sheet turns its normals all around).
constexpr double kWide = 0.5;
// A cell without a change of sign is looked at more closely if its corners' normals are further than 32° from
// their mean (at 60°, sheets between the corners are missed: 57 instead of 4 tolerances on igea).
constexpr double kTurning = 0.85;

// Are the inside corners connected along the cube's edges, and the outside corners too? Then the cell has one
// sheet of surface.
constexpr bool one_sheet(unsigned inside) {
    for (const unsigned set : {inside, ~inside & 255U}) {
        if (set == 0) continue;
        unsigned reached = set & (~set + 1);
        for (int round = 0; round < 8; ++round)
            for (unsigned i = 0; i < 8; ++i)
                if (reached >> i & 1)
                    for (unsigned axis = 0; axis < 3; ++axis) reached |= (1U << (i ^ (1U << axis))) & set;
        if (reached != set) return false;
    }
    return true;
}

constexpr auto kOneSheet = [] {
    std::array<bool, 256> table{};
    for (unsigned i = 0; i < 256; ++i) table[i] = one_sheet(i);
    return table;
}();

Vec3 normal_of(const Sample& s) {
    return {s.normal[0], s.normal[1], s.normal[2]};
}

// Is a corner's normal further from `axis` than the cosine allows? Where a gradient vanishes, too.
bool spread(const std::array<const Sample*, 8>& corners, const Vec3& axis, double cosine) {
    for (const Sample* corner : corners)
        if (!(dot(normal_of(*corner), axis) >= cosine)) return true;
    return false;
}

void evaluate(const CubeField& field, Sample& sample, bool with_normal) {
    if (!with_normal) {
        sample.value = field.value(sample.point);
        return;
    }
    Vec3 gradient;
    sample.value = field.value_and_gradient(sample.point, gradient);
    const Vec3 n = is_finite(gradient) ? normalized(gradient) : Vec3{};
    sample.normal = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

}  // namespace

Octree::Octree(const CubeField& field, const PolygonizeOptions& options, double chord, const Task& task)
    : field_(field), options_(options), task_(task), chord_(chord), nodes_(1) {
    nodes_[0].may_cross = field_.may_cross(nodes_[0].corner, field_.side());
    refine();
    balance();
}

std::int32_t Octree::find(const LatticePoint& corner, int depth) const {
    std::int32_t at = 0;
    for (int d = 1; d <= depth && nodes_[at].children >= 0; ++d) {
        const int bit = options_.max_depth - d;
        at = nodes_[at].children +
             ((corner[0] >> bit & 1) | (corner[1] >> bit & 1) << 1 | (corner[2] >> bit & 1) << 2);
    }
    return at;
}

bool Octree::contains(const LatticePoint& cell) const {
    for (const std::int32_t c : cell)
        if (c < 0 || c >= field_.side()) return false;
    return true;
}

bool Octree::is_split(const LatticePoint& corner, int depth) const {
    if (depth >= deepest_ || !contains(corner)) return false;
    const OctreeNode& node = nodes_[find(corner, depth)];
    return node.depth == depth && !node.leaf();
}

double Octree::value(const LatticePoint& p) const {
    const Sample* sample = samples_.find(p);
    return sample ? sample->value : field_.value(p);
}

void Octree::refine() {
    std::vector<std::int32_t> cells;
    if (nodes_[0].may_cross) cells.push_back(0);
    for (int depth = 0; !cells.empty(); ++depth) {
        task_.report(0.4 * depth / (options_.max_depth + 1), "cells");
        if (depth >= options_.min_depth) sample_corners(cells, depth < options_.max_depth);
        if (depth == options_.max_depth) break;
        cells = split(depth < options_.min_depth ? cells : cells_to_split(cells));
    }
}

// Gives the parents children; returns those that the surface can cross.
std::vector<std::int32_t> Octree::split(const std::vector<std::int32_t>& parents) {
    const std::size_t first = nodes_.size(), total = first + 8 * parents.size();
    if (total > std::min(options_.max_cells, kMostCells))
        throw LimitExceeded("polygonize: more than max_cells = " + std::to_string(options_.max_cells) +
                            " cells");
    nodes_.resize(total);
    add_blocks(parents);
    parallel_chunks(parents.size(), kChunk / 8, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            add_children(nodes_[parents[i]], static_cast<std::int32_t>(first + 8 * i));
    });
    std::vector<std::int32_t> survivors;
    for (std::size_t i = first; i < total; ++i) {
        deepest_ = std::max<int>(deepest_, nodes_[i].depth);
        if (nodes_[i].may_cross) survivors.push_back(static_cast<std::int32_t>(i));
    }
    return survivors;
}

void Octree::add_children(OctreeNode& parent, std::int32_t first) {
    parent.children = first;
    const CubeField local = field(parent.block);
    const std::int32_t size = size_at(parent.depth + 1);
    const Tangent tangent = local.tangent(parent.corner, 2 * size);
    const double half = size * local.step() / 2;
    const Vec3 extent{half, half, half};
    const Vec3& g = tangent.gradient;
    const bool flat = tangent.error <= kFlat * half * (std::abs(g.x) + std::abs(g.y) + std::abs(g.z));
    for (int k = 0; k < 8; ++k) {
        OctreeNode& child = nodes_[first + k];
        child.depth = static_cast<std::uint8_t>(parent.depth + 1);
        child.block = parent.block;
        child.corner = cube_corner(parent.corner, size, k);
        const Vec3 offset{k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half};
        child.may_cross = flat ? local.may_cross(child.corner, size, tangent.over(offset, extent))
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
    parallel_chunks(chosen.size(), kChunk / 8, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            OctreeNode& node = nodes_[chosen[i]];
            blocks_[first + i] = field_.pruned(node.corner, size_at(node.depth));
            if (blocks_[first + i]) node.block = static_cast<std::int32_t>(first + i);
        }
    });
}

void Octree::sample_corners(const std::vector<std::int32_t>& cells, bool with_normals) {
    const std::size_t first = samples_.size();
    std::vector<std::array<std::int32_t, 8>> rows(cells.size());
    std::vector<std::int32_t> blocks;  // of the new samples
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i % 1024 == 0) task_.check();
        const OctreeNode& node = nodes_[cells[i]];
        for (int k = 0; k < 8; ++k)
            rows[i][k] = samples_.find_or_add(cube_corner(node.corner, size_at(node.depth), k));
        blocks.resize(samples_.size() - first, node.block);
    }
    parallel_chunks(samples_.size() - first, kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            evaluate(field(blocks[i]), samples_[first + i], with_normals);
    });
    for (std::size_t i = 0; i < cells.size(); ++i) {
        OctreeNode& node = nodes_[cells[i]];
        node.sampled = true;
        node.inside = 0;
        for (int k = 0; k < 8; ++k)
            if (samples_[rows[i][k]].value >= 0) node.inside |= static_cast<std::uint8_t>(1 << k);
    }
}

// The cells (above max_depth, with sampled corners) that one more level would serve better. Their centres are
// kept as samples, since they become corners.
std::vector<std::int32_t> Octree::cells_to_split(const std::vector<std::int32_t>& cells) {
    std::vector<Sample> centres(cells.size());
    std::vector<char> wanted(cells.size());
    parallel_chunks(cells.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) wanted[i] = should_split(nodes_[cells[i]], centres[i]);
    });
    std::vector<std::int32_t> chosen;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!wanted[i]) continue;
        chosen.push_back(cells[i]);
        samples_[samples_.find_or_add(centres[i].point)] = centres[i];
    }
    return chosen;
}

// If so, `centre` is filled in.
bool Octree::should_split(const OctreeNode& node, Sample& centre) const {
    std::array<const Sample*, 8> corners{};
    Vec3 mean;
    for (int k = 0; k < 8; ++k) {
        corners[k] = samples_.find(cube_corner(node.corner, size_at(node.depth), k));
        mean += normal_of(*corners[k]);
    }
    if (!node.mixed() && !spread(corners, normalized(mean), kTurning)) return false;  // no room for a sheet
    centre.point = cube_corner(node.corner, size_at(node.depth + 1), 7);
    evaluate(field(node.block), centre, true);
    if (spread(corners, normal_of(centre), kWide)) return true;
    if (!node.mixed()) return (node.inside == 255) != (centre.value >= 0);
    return !kOneSheet[node.inside] || chord(corners, centre) > chord_;
}

// For a chord from the centre to a corner, normals n and n' at its ends and the vector d between them, the
// arc's height is |(n' - n)·d| / 8 up to third order; an edge of the mesh is some 1.4 times as long.
double Octree::chord(const std::array<const Sample*, 8>& corners, const Sample& centre) const {
    double highest = 0;
    for (const Sample* corner : corners) {
        const Vec3 d = field_.position(corner->point) - field_.position(centre.point);
        highest = std::max(highest, std::abs(dot(normal_of(*corner) - normal_of(centre), d)) / 4);
    }
    return highest;
}

}  // namespace pfgeom
