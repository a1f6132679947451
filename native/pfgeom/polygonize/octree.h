// The cells of the polygonizer: a complete octree (a node has eight children or none), fine where the surface
// bends, with the signs of the field at the corners of the cells that the surface can cross.
#pragma once

#include "pfgeom/base/parallel.h"
#include "pfgeom/polygonize/cube_field.h"
#include "pfgeom/polygonize/polygonize.h"
#include "pfgeom/polygonize/samples.h"

#include <memory>
#include <vector>

namespace pfgeom {

struct OctreeNode {
    LatticePoint corner{};       ///< the low one
    std::int32_t children = -1;  ///< the first of eight in a row, in the order of cube_corner
    std::int32_t block = -1;     ///< see Octree::field
    std::int32_t corners = -1;   ///< see Octree::corners
    std::uint8_t depth = 0;
    std::uint8_t inside = 0;  ///< bit i: corner i is inside; 0 where that has not been looked at
    bool may_cross = false;   ///< the field can have a zero in the cell

    bool leaf() const { return children < 0; }
    bool mixed() const { return inside != 0 && inside != 255; }
};

/// Calls body(from, to) for the longest runs of [begin, end) that are of one block.
template <class BlockOf, class Body>
void for_runs(std::size_t begin, std::size_t end, BlockOf block_of, Body body) {
    for (std::size_t from = begin, to; from < end; from = to) {
        for (to = from + 1; to < end && block_of(to) == block_of(from);) ++to;
        body(from, to);
    }
}

class Octree {
  public:
    /// Cells are split until the mesh of one of them can be expected within `chord` of the surface.
    Octree(const CubeField& field, const PolygonizeOptions& options, double chord, const Task& task);

    const std::vector<OctreeNode>& nodes() const { return nodes_; }
    const CubeField& field() const { return field_; }
    /// The same field as it is best evaluated in the cells of a block; -1: anywhere.
    CubeField field(std::int32_t block) const {
        return block < 0 ? field_ : CubeField(*blocks_[static_cast<std::size_t>(block)], options_.max_depth);
    }
    std::int32_t size_at(int depth) const { return field_.side() >> depth; }
    /// The deepest node of at most `depth` that holds the lattice cell at `corner`.
    std::int32_t find(const LatticePoint& corner, int depth) const;
    /// Has the cell of `depth` at `corner` children? No for cells outside the cube.
    bool is_split(const LatticePoint& corner, int depth) const;
    std::vector<std::int32_t> mixed_leaves() const;
    /// Are all neighbours of the leaf at least as large?
    bool plain(const OctreeNode& leaf) const { return leaf.depth == deepest_; }
    bool contains(const LatticePoint& cell) const;
    /// The field at a lattice point: looked up, or else evaluated.
    double value(const LatticePoint& p) const;

    /// Rows of a cell's corners among the samples.
    using Corners = std::array<std::int32_t, 8>;
    /// Of a mixed cell.
    const Corners& corners(const OctreeNode& node) const {
        return corners_[static_cast<std::size_t>(node.corners)];
    }
    const Samples& samples() const { return samples_; }
    /// Only the fields are needed from now on.
    void free_cells();

  private:
    // A job is some 0.1 ms, and cancel polls between jobs.
    static constexpr std::size_t kChunk = 128;            // cells or points a job
    static constexpr std::size_t kFamilies = kChunk / 8;  // parents a job

    void refine();
    void balance();
    bool uniform() const { return options_.min_depth == options_.max_depth; }
    std::vector<std::int32_t> split(std::vector<std::int32_t> parents);
    std::vector<Tangent> tangents_in(const std::vector<std::int32_t>& cells) const;
    void keep_crossed(std::vector<std::int32_t>& cells, std::vector<Tangent>& tangents);
    void add_children(OctreeNode& parent, std::int32_t first, const Tangent& tangent);
    void add_blocks(const std::vector<std::int32_t>& cells);
    void sample_corners(std::span<const std::int32_t> cells);
    std::vector<Corners> sample_corners(std::span<const std::int32_t> cells, bool with_normals);
    struct NewSample {
        LatticePoint point{};
        std::int32_t block = -1;
    };
    void evaluate(std::span<const NewSample> added, std::size_t first, bool with_normals);
    struct Centre {
        LatticePoint point{};
        Samples::Normal normal{};
        double value = 0;
    };
    std::vector<std::int32_t> cells_to_split(const std::vector<std::int32_t>& cells,
                                             const std::vector<Corners>& corners);
    bool should_split(const OctreeNode& node, const Corners& corners, Centre& centre) const;
    double chord(const OctreeNode& node, const std::array<Vec3, 8>& normals, const Centre& centre) const;
    void add_coarse_neighbours(const OctreeNode& parent, std::vector<std::int32_t>& coarse) const;

    const CubeField& field_;
    const PolygonizeOptions& options_;
    const Task& task_;
    double chord_;
    int deepest_ = 0;
    std::vector<OctreeNode> nodes_;
    std::vector<std::unique_ptr<const ScalarField>> blocks_;  // fields within cells of one depth
    Samples samples_;
    std::vector<Corners> corners_;  // of mixed cells
};

}  // namespace pfgeom
