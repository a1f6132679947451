// The cells of the polygonizer: a complete octree (a node has eight children or none), fine where the surface
// bends, with the signs of the field at the corners of the cells that the surface can cross.
#pragma once

#include "pfgeom/base/parallel.h"
#include "pfgeom/polygonize/cube_field.h"
#include "pfgeom/polygonize/polygonize.h"
#include "pfgeom/polygonize/samples.h"

#include <vector>

namespace pfgeom {

struct OctreeNode {
    LatticePoint corner{};       ///< the low one
    std::int32_t children = -1;  ///< the first of eight in a row, in the order of cube_corner
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
    Samples samples_;
};

}  // namespace pfgeom
