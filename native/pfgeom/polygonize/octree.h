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
    std::uint8_t depth = 0;
    std::uint8_t inside = 0;  ///< bit i: corner i is inside; only where `sampled`
    bool may_cross = false;   ///< the field's range in the cell contains 0
    bool sampled = false;     ///< all corners are in `samples`

    bool leaf() const { return children < 0; }
    bool mixed() const { return inside != 0 && inside != 255; }
};

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
    bool contains(const LatticePoint& cell) const;
    /// The field at a lattice point: looked up, or else evaluated.
    double value(const LatticePoint& p) const;

  private:
    void refine();
    void balance();
    std::vector<std::int32_t> split(const std::vector<std::int32_t>& parents);
    void add_children(OctreeNode& parent, std::int32_t first);
    void add_blocks(const std::vector<std::int32_t>& cells);
    void sample_corners(const std::vector<std::int32_t>& cells, bool with_normals);
    std::vector<std::int32_t> cells_to_split(const std::vector<std::int32_t>& cells);
    bool should_split(const OctreeNode& node, Sample& centre) const;
    double chord(const std::array<const Sample*, 8>& corners, const Sample& centre) const;
    void add_coarse_neighbours(const OctreeNode& parent, std::vector<std::int32_t>& coarse) const;

    const CubeField& field_;
    const PolygonizeOptions& options_;
    const Task& task_;
    double chord_;
    int deepest_ = 0;
    std::vector<OctreeNode> nodes_;
    std::vector<std::unique_ptr<const ScalarField>> blocks_;  // fields within cells of one depth
    Samples samples_;
};

}  // namespace pfgeom
