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
#include "pfgeom/polygonize/leaf_surface.h"
#include "pfgeom/polygonize/project.h"

#include <map>
#include <string>

namespace pfgeom {
namespace {

constexpr std::size_t kChunk = 64;  // leaves or vertices a job
// A vertex may leave its cell, but not by so much that it folds over the next cell's.
constexpr double kReach = 0.75;  // of the cell's side, from the mean of the cell's crossings

struct CrossedEdge {
    LatticeEdge edge;
    std::int32_t length = 0;
    std::array<std::int32_t, 4> vertex{-1, -1, -1, -1};  // by quadrant
    std::uint8_t own = 0;                                // quadrants whose leaf has the edge undivided
    bool rising = false;
};

// Where a vertex starts from, and a crossed edge to fall back to.
struct Seed {
    Vec3 point;
    std::int32_t size = 0;
    std::int32_t edge = -1;
    std::int32_t block = -1;  // of the octree
};

class DualMesher {
  public:
    DualMesher(const Octree& octree, double accuracy, std::size_t max_faces, const Task& task)
        : octree_(octree), accuracy_(accuracy), max_faces_(max_faces), task_(task) {}

    SurfaceMesh run() {
        std::vector<std::int32_t> leaves;
        for (std::size_t i = 0; i < octree_.nodes().size(); ++i)
            if (octree_.nodes()[i].leaf() && octree_.nodes()[i].mixed())
                leaves.push_back(static_cast<std::int32_t>(i));
        for (; !leaves.empty(); leaves = leaves_missing()) add_leaves(leaves);
        task_.report(0.5, "cells");
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            if (i % 1024 == 0) task_.check();
            add_polygon(edges_[i]);
        }
        place_vertices();
        mesh_.set_faces(std::move(faces_), {});
        return std::move(mesh_);
    }

  private:
    void add_leaves(const std::vector<std::int32_t>& leaves);
    void add_sheets(const OctreeNode& leaf, const LeafSheets& sheets);
    std::int32_t edge_row(const LatticeEdge& edge);
    std::vector<std::int32_t> leaves_missing() const;
    void add_polygon(const CrossedEdge& e);
    void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c);
    void place_vertices();
    SurfacePoint fallback(const Seed& seed) const;

    const Octree& octree_;
    double accuracy_;
    std::size_t max_faces_;
    const Task& task_;
    std::vector<CrossedEdge> edges_;
    std::vector<std::int32_t> slots_;                   // open addressing over edges_, as in Samples
    std::map<std::uint64_t, std::int32_t> piece_rows_;  // (edge, direction) of a face's piece -> vertex
    std::vector<Seed> seeds_;
    std::vector<Triangle> faces_;
    SurfaceMesh mesh_;
};

std::int32_t DualMesher::edge_row(const LatticeEdge& edge) {
    const auto slot_of = [this](std::uint64_t key) {
        std::size_t slot = hash_key(key) & (slots_.size() - 1);
        while (slots_[slot] >= 0 && edges_[slots_[slot]].edge.key() != key)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    };
    if (2 * edges_.size() >= slots_.size()) {
        slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), -1);
        for (std::size_t i = 0; i < edges_.size(); ++i)
            slots_[slot_of(edges_[i].edge.key())] = static_cast<std::int32_t>(i);
    }
    std::int32_t& row = slots_[slot_of(edge.key())];
    if (row < 0) {
        row = static_cast<std::int32_t>(edges_.size());
        edges_.push_back({.edge = edge});
    }
    return row;
}

void DualMesher::add_leaves(const std::vector<std::int32_t>& leaves) {
    constexpr std::size_t kBatch = 256 * kChunk;  // bounds the memory of what waits to be merged
    for (std::size_t batch = 0; batch < leaves.size(); batch += kBatch) {
        std::vector<LeafSheets> found(std::min(kBatch, leaves.size() - batch));
        parallel_chunks(found.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                find_sheets(octree_, octree_.nodes()[leaves[batch + i]], found[i]);
        });
        for (std::size_t i = 0; i < found.size(); ++i)
            add_sheets(octree_.nodes()[leaves[batch + i]], found[i]);
        task_.check();
    }
}

void DualMesher::add_sheets(const OctreeNode& leaf, const LeafSheets& sheets) {
    const auto first = static_cast<std::int32_t>(seeds_.size());
    seeds_.resize(seeds_.size() + sheets.count);
    std::vector<int> uses(sheets.count);
    for (const Crossing& c : sheets.crossings) {
        const std::int32_t row = edge_row(c.edge);
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
        seeds_.push_back({piece.point, piece.size, edge_row(piece.a)});
    }
}

// Leaves at crossed edges that have not been looked at: large ones whose own corners have one sign.
std::vector<std::int32_t> DualMesher::leaves_missing() const {
    std::vector<std::int32_t> missing;
    for (const CrossedEdge& e : edges_) {
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
    if (faces_.size() >= max_faces_)
        throw LimitExceeded("polygonize: more than max_faces = " + std::to_string(max_faces_) + " faces");
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
        seeds_.push_back({centre, e.length, static_cast<std::int32_t>(&e - edges_.data())});
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
    mesh_.position.resize(seeds_.size());
    mesh_.normal.resize(seeds_.size());
    parallel_chunks(seeds_.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Seed& seed = seeds_[i];
            SurfacePoint p;
            const double reach = kReach * seed.size * octree_.field().step();
            if (!project(octree_.field(seed.block), seed.point, reach, accuracy_, p)) p = fallback(seed);
            mesh_.position[i] = p.position;
            mesh_.normal[i] = p.normal;
        }
    });
}

}  // namespace

SurfaceMesh dual_mesh(const Octree& octree, double accuracy, std::size_t max_faces, const Task& task) {
    return DualMesher(octree, accuracy, max_faces, task).run();
}

}  // namespace pfgeom
