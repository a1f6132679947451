// Refinement of the octree. A cell is split where the unit gradients at its eight corners and its centre say
// that a mesh with edges of its size would leave the chord tolerance, or that the cell may hold more than one
// sheet.
//
// Sources: range test of cells, J. M. Snyder, "Interval analysis for computer graphics", SIGGRAPH 1992;
// Hermite data for the error of a cell, T. Ju et al., "Dual contouring of Hermite data", SIGGRAPH 2002.
// Departure: no least-squares vertex is solved for; the change of normals times the distance estimates the
// error.
#include "pfgeom/polygonize/octree.h"

#include "pfgeom/polygonize/plain_leaf.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Normals further apart than 60° within half a cell: its surface is no height field, and in a cell without a
// change of sign a small sheet may hide (a closed sheet turns its normals all around).
constexpr double kWide = 0.5;
// A cell without a change of sign is looked at more closely if its corners' normals are further than 32° from
// their mean (at 60°, sheets between the corners are missed: 57 instead of 4 tolerances on igea).
constexpr double kTurning = 0.85;

bool one_sheet(std::uint8_t inside) {
    const PlainLeaf& leaf = plain_leaf(inside);
    return leaf.sheets <= 1 && !leaf.ambiguous;
}

Vec3 vector_of(const Samples::Normal& n) {
    return {n[0], n[1], n[2]};
}

// Is one of the normals further from `axis` than the cosine allows? Where a gradient vanishes, too.
bool spread(const std::array<Vec3, 8>& normals, const Vec3& axis, double cosine) {
    for (const Vec3& normal : normals)
        if (!(dot(normal, axis) >= cosine)) return true;
    return false;
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

std::vector<std::int32_t> Octree::mixed_leaves() const {
    std::vector<std::int32_t> leaves;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (i % 1024 == 0) task_.check();
        if (nodes_[i].leaf() && nodes_[i].mixed()) leaves.push_back(static_cast<std::int32_t>(i));
    }
    return leaves;
}

void Octree::free_cells() {
    std::vector<OctreeNode>().swap(nodes_);
    task_.check();
    std::vector<Corners>().swap(corners_);
    task_.check();
    samples_ = {};
    task_.check();
}

bool Octree::is_split(const LatticePoint& corner, int depth) const {
    if (depth >= deepest_ || !contains(corner)) return false;
    const OctreeNode& node = nodes_[find(corner, depth)];
    return node.depth == depth && !node.leaf();
}

void Octree::refine() {
    std::vector<std::int32_t> cells;
    if (nodes_[0].may_cross) cells.push_back(0);
    for (int depth = 0; !cells.empty(); ++depth) {
        task_.report(0.4 * depth / (options_.max_depth + 1), "cells");
        if (depth < options_.min_depth) {
            cells = split(std::move(cells));
            continue;
        }
        if (depth == options_.max_depth) {
            sample_corners(cells);
            break;
        }
        const std::vector<Corners> corners = sample_corners(cells, true);
        cells = split(cells_to_split(cells, corners));
    }
}

// The cells (above max_depth, with sampled corners) that one more level would serve better. Their centres are
// kept as samples, since they become corners.
std::vector<std::int32_t> Octree::cells_to_split(const std::vector<std::int32_t>& cells,
                                                 const std::vector<Corners>& corners) {
    std::vector<Centre> centres(cells.size());
    std::vector<char> wanted(cells.size());
    parallel_chunks(cells.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            wanted[i] = should_split(nodes_[cells[i]], corners[i], centres[i]);
    });
    std::vector<std::int32_t> chosen;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!wanted[i]) continue;
        chosen.push_back(cells[i]);
        const std::int32_t row = samples_.find_or_add(centres[i].point);
        samples_.add_normals();
        samples_.set(static_cast<std::size_t>(row), centres[i].value, centres[i].normal);
    }
    return chosen;
}

// If so, `centre` is filled in.
bool Octree::should_split(const OctreeNode& node, const Corners& corners, Centre& centre) const {
    std::array<Vec3, 8> normals;
    Vec3 mean;
    for (int k = 0; k < 8; ++k) {
        normals[k] = vector_of(samples_.normal(corners[k]));
        mean += normals[k];
    }
    if (!node.mixed() && !spread(normals, normalized(mean), kTurning)) return false;  // no room for a sheet
    Vec3 gradient;
    centre.point = cube_corner(node.corner, size_at(node.depth + 1), 7);
    centre.value = field(node.block).value_and_gradient(centre.point, gradient);
    centre.normal = Samples::normal_of(gradient);
    if (spread(normals, vector_of(centre.normal), kWide)) return true;
    if (!node.mixed()) return (node.inside == 255) != (centre.value >= 0);
    return !one_sheet(node.inside) || chord(node, normals, centre) > chord_;
}

// For a chord from the centre to a corner, normals n and n' at its ends and the vector d between them, the
// arc's height is |(n' - n)·d| / 8 up to third order; an edge of the mesh is some 1.4 times as long.
double Octree::chord(const OctreeNode& node, const std::array<Vec3, 8>& normals, const Centre& centre) const {
    double highest = 0;
    for (int k = 0; k < 8; ++k) {
        const Vec3 d =
            field_.position(cube_corner(node.corner, size_at(node.depth), k)) - field_.position(centre.point);
        highest = std::max(highest, std::abs(dot(normals[k] - vector_of(centre.normal), d)) / 4);
    }
    return highest;
}

}  // namespace pfgeom
