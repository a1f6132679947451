// Dual mesh of the octree: every minimal edge that the surface crosses becomes a polygon of the sheets in the
// three or four leaves about it.
//
// Sources: T. Ju, F. Losasso, S. Schaefer, J. Warren, "Dual contouring of Hermite data", SIGGRAPH 2002; S.
// Schaefer, T. Ju, J. Warren, "Manifold dual contouring", IEEE TVCG 13(3), 2007. Departures:
//
// Leaves are reached through crossed edges until every quadrant about each of them is accounted for, so the
// mesh is closed even if a field's range() is wrong and cells were dropped that should not have been.
//
// The disks of leaf_surface.cpp form a closed 2-manifold, and so does their dual, as a cell complex. As a
// list of indexed triangles it needs more: no two edges with the same ends. Two leaves share at most one
// minimal face, so this can only happen where a face has several pieces of surface (each of them then gets a
// vertex of its own in the middle) and between opposite leaves about an edge that is smaller than both (no
// diagonal is drawn there).
#include "pfgeom/polygonize/dual.h"

#include "pfgeom/base/sort_unique.h"
#include "pfgeom/polygonize/crossed_edges.h"
#include "pfgeom/polygonize/leaf_surface.h"
#include "pfgeom/polygonize/plain_leaf.h"
#include "pfgeom/polygonize/project.h"

#include <map>
#include <string>

namespace pfgeom {
namespace {

constexpr std::size_t kChunk = 64;  // leaves or vertices a job

// Most leaves have one sheet, and there are about as many crossed edges as sheets: room for a little more.
std::size_t with_spare(std::size_t leaves) {
    return leaves + leaves / 16;
}

// A vertex may leave its cell, but not by so much that it folds over the next cell's.
constexpr double kReach = 0.75;  // of the cell's side, from the mean of the cell's crossings

// Where a vertex starts from, and a crossed edge to fall back to.
struct Seed {
    Vec3 point;
    std::int32_t size = 0;
    std::int32_t edge = -1;
    std::int32_t block = -1;  // of the octree
};

class DualMesher {
  public:
    DualMesher(Octree& octree, const DualOptions& options, const Task& task)
        : octree_(octree),
          options_(options),
          task_(task),
          leaves_(octree.mixed_leaves()),
          edges_(octree.samples(), with_spare(leaves_.size()), task) {
        seeds_.reserve(with_spare(leaves_.size()));
        faces_.reserve(2 * with_spare(leaves_.size()));
    }

    SurfaceMesh run() {
        for (; !leaves_.empty(); leaves_ = leaves_missing()) add_leaves(leaves_);
        edges_.stop_finding();
        octree_.free_cells();
        task_.report(0.5, "cells");
        for (std::size_t i = 0; i < edges_.list().size(); ++i) {
            if (i % 1024 == 0) task_.check();
            add_polygon(edges_.list()[i]);
        }
        place_vertices();
        mesh_.set_faces(std::move(faces_), {});
        return std::move(mesh_);
    }

  private:
    void add_leaves(const std::vector<std::int32_t>& leaves);
    void add_sheets(const OctreeNode& leaf, const LeafSheets& sheets);
    bool is_plain(const OctreeNode& leaf) const;
    void add_plain_sheets(const OctreeNode& leaf);
    std::vector<std::int32_t> leaves_missing() const;
    void add_polygon(const CrossedEdge& e);
    void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c);
    void place_vertices();
    void place_vertices(std::size_t from, std::size_t to);
    SurfacePoint fallback(const Seed& seed) const;

    Octree& octree_;
    const DualOptions& options_;
    const Task& task_;
    std::vector<std::int32_t> leaves_;  // to be looked at
    CrossedEdges edges_;
    std::map<std::uint64_t, std::int32_t> piece_rows_;  // (edge, direction) of a face's piece -> vertex
    std::vector<Seed> seeds_;
    std::vector<Triangle> faces_;
    SurfaceMesh mesh_;
};

void DualMesher::add_leaves(const std::vector<std::int32_t>& leaves) {
    constexpr std::size_t kBatch = 256 * kChunk;  // bounds the memory of what waits to be merged
    for (std::size_t batch = 0; batch < leaves.size(); batch += kBatch) {
        std::vector<LeafSheets> found(std::min(kBatch, leaves.size() - batch));
        parallel_chunks(found.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (const OctreeNode& leaf = octree_.nodes()[leaves[batch + i]]; !is_plain(leaf))
                    find_sheets(octree_, leaf, found[i]);
        });
        for (std::size_t i = 0; i < found.size(); ++i) {
            const OctreeNode& leaf = octree_.nodes()[leaves[batch + i]];
            if (is_plain(leaf))
                add_plain_sheets(leaf);
            else
                add_sheets(leaf, found[i]);
        }
        task_.check();
    }
}

bool DualMesher::is_plain(const OctreeNode& leaf) const {
    return leaf.mixed() && octree_.plain(leaf) && !plain_leaf(leaf.inside).ambiguous;
}

void DualMesher::add_plain_sheets(const OctreeNode& leaf) {
    const PlainLeaf& plain = plain_leaf(leaf.inside);
    const Octree::Corners& corners = octree_.corners(leaf);
    const std::int32_t size = octree_.size_at(leaf.depth);
    const auto first = static_cast<std::int32_t>(seeds_.size());
    seeds_.resize(seeds_.size() + plain.sheets, {.point = {}, .size = size, .block = leaf.block});
    std::array<int, 4> uses{};
    for (const PlainCrossing& c : std::span(plain.crossing).first(plain.crossings)) {
        const double low = octree_.samples().value(corners[c.low]);
        const double high = octree_.samples().value(corners[c.high]);
        const LatticeEdge edge{cube_corner(leaf.corner, size, c.low), c.axis};
        const std::int32_t row = edges_.find_or_add(edge, corners[c.low]);
        CrossedEdge& e = edges_[row];
        e.length = size;
        e.rising = high >= 0;
        e.vertex[c.quadrant] = first + c.sheet;
        e.own |= static_cast<std::uint8_t>(1U << c.quadrant);
        Seed& seed = seeds_[first + c.sheet];
        seed.point += crossing_point(octree_.field(), edge, size, low, high);
        seed.edge = row;
        ++uses[c.sheet];
    }
    for (std::int32_t s = 0; s < plain.sheets; ++s) seeds_[first + s].point *= 1.0 / uses[s];
}

void DualMesher::add_sheets(const OctreeNode& leaf, const LeafSheets& sheets) {
    const auto first = static_cast<std::int32_t>(seeds_.size());
    seeds_.resize(seeds_.size() + sheets.count);
    std::vector<int> uses(sheets.count);
    for (const Crossing& c : sheets.crossings) {
        const std::int32_t row = edges_.find_or_add(c.edge);
        CrossedEdge& e = edges_[row];
        e.length = c.length;
        e.rising = c.rising;
        for (int q = 0; q < 4; ++q)
            if (c.quadrants >> q & 1) e.vertex[q] = first + c.sheet;
        if (c.own) e.own |= c.quadrants;
        Seed& seed = seeds_[first + c.sheet];
        seed.point += c.point;
        seed.size = octree_.size_at(leaf.depth);
        seed.edge = row;
        seed.block = leaf.block;
        ++uses[c.sheet];
    }
    for (std::int32_t s = 0; s < sheets.count; ++s) seeds_[first + s].point *= 1.0 / uses[s];
    for (const FacePiece& piece : sheets.pieces) {
        const std::uint64_t a = piece.a.key() << 2 | piece.a_direction,
                            b = piece.b.key() << 2 | piece.b_direction;
        if (piece_rows_.contains(a)) continue;  // the other leaf brought it
        piece_rows_[a] = piece_rows_[b] = static_cast<std::int32_t>(seeds_.size());
        seeds_.push_back({piece.point, piece.size, edges_.find_or_add(piece.a)});
    }
}

// Leaves at crossed edges that have not been looked at: large ones whose own corners have one sign.
std::vector<std::int32_t> DualMesher::leaves_missing() const {
    std::vector<std::int32_t> missing;
    for (const CrossedEdge& e : edges_.list()) {
        for (int q = 0; q < 4; ++q) {
            if (e.vertex[q] >= 0) continue;
            const LatticePoint cell =
                moved(moved(e.edge.low, next_axis(e.edge.axis), q == 0 || q == 3 ? -1 : 0),
                      last_axis(e.edge.axis), q < 2 ? -1 : 0);
            missing.push_back(octree_.find(cell, kDeepest));
        }
    }
    sort_unique(missing);
    return missing;
}

void DualMesher::add_triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    if (faces_.size() >= options_.max_faces)
        throw LimitExceeded("polygonize: more than max_faces = " + std::to_string(options_.max_faces) +
                            " faces");
    faces_.push_back({a, b, c});
}

void DualMesher::add_polygon(const CrossedEdge& e) {
    std::array<std::int32_t, 8> ring{};
    std::size_t n = 0;
    bool plain = true;
    for (int q = 0; q < 4; ++q) {
        const int after = (q + 1) % 4;
        if (e.vertex[q] == e.vertex[after]) continue;  // one leaf on both sides
        ring[n++] = e.vertex[q];
        const auto piece = piece_rows_.empty()
                               ? piece_rows_.end()
                               : piece_rows_.find(e.edge.key() << 2 | static_cast<std::uint64_t>(q));
        if (piece == piece_rows_.end()) continue;
        ring[n++] = piece->second;
        plain = false;
    }
    // Counter-clockwise seen from the high end, which is the outside unless the edge rises.
    if (e.rising) std::reverse(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(n));
    const auto at = [&](std::size_t i) { return seeds_[ring[i]].point; };
    if (plain && n == 3) {
        add_triangle(ring[0], ring[1], ring[2]);
    } else if (plain && n == 4) {
        // Quadrants 0 and 2 (or 1 and 3) may be joined if one of them has the edge undivided.
        const bool even = e.own & (e.rising ? 0b1010 : 0b0101);  // ring[0] is quadrant 0, or 3 if reversed
        const bool odd = e.own & (e.rising ? 0b0101 : 0b1010);
        const bool shorter_even = squared_norm(at(0) - at(2)) <= squared_norm(at(1) - at(3));
        const std::size_t s = even && (!odd || shorter_even) ? 0 : 1;
        add_triangle(ring[s], ring[s + 1], ring[(s + 2) % 4]);
        add_triangle(ring[s], ring[(s + 2) % 4], ring[(s + 3) % 4]);
    } else {
        Vec3 centre;
        for (std::size_t i = 0; i < n; ++i) centre += at(i) * (1.0 / static_cast<double>(n));
        const auto hub = static_cast<std::int32_t>(seeds_.size());
        seeds_.push_back({centre, e.length, static_cast<std::int32_t>(&e - edges_.list().data())});
        for (std::size_t i = 0; i < n; ++i) add_triangle(ring[i], ring[(i + 1) % n], hub);
    }
}

// The zero on one of the vertex's crossed edges.
SurfacePoint DualMesher::fallback(const Seed& seed) const {
    const CrossedEdge& e = edges_[seed.edge];
    const CubeField& field = octree_.field();
    const Vec3 low = field.position(e.edge.low),
               high = field.position(moved(e.edge.low, e.edge.axis, e.length));
    return e.rising ? bisect(field, high, low) : bisect(field, low, high);
}

void DualMesher::place_vertices() {
    grow(mesh_.position, seeds_.size(), task_);
    if (options_.normals) grow(mesh_.normal, seeds_.size(), task_);
    parallel_chunks(seeds_.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for_runs(
            begin, end, [&](std::size_t i) { return seeds_[i].block; },
            [&](std::size_t from, std::size_t to) { place_vertices(from, to); });
    });
}

// Of one block.
void DualMesher::place_vertices(std::size_t from, std::size_t to) {
    const CubeField field = octree_.field(seeds_[from].block);
    std::array<Vec3, kChunk> points, gradients;
    std::array<double, kChunk> values;
    for (std::size_t i = from; i < to; ++i) points[i - from] = seeds_[i].point;
    field.values_and_gradients(std::span(points).first(to - from), values, gradients);
    for (std::size_t i = from; i < to; ++i) {
        const Seed& seed = seeds_[i];
        const Jet start{values[i - from], gradients[i - from]};
        SurfacePoint p;
        const double reach = kReach * seed.size * field.step();
        if (!project(field, seed.point, start, reach, options_.accuracy, p)) p = fallback(seed);
        mesh_.position[i] = p.position;
        if (options_.normals) mesh_.normal[i] = p.normal;
    }
}

}  // namespace

SurfaceMesh dual_mesh(Octree& octree, const DualOptions& options, const Task& task) {
    return DualMesher(octree, options, task).run();
}

}  // namespace pfgeom
