// The surface of a set tree between tetrahedra: a conforming partition of the space near it, each of whose
// parts lies on one side of every question that matters there.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/eval/pruned_tree.h"
#include "pfgeom/polygonize/polygonize.h"
#include "pfgeom/polygonize/tetrahedra.h"

namespace pfgeom {

/// Questions on whose zero sets a vertex has been put; -1 fills up. More than six are not remembered.
using Zeros = std::array<std::int32_t, 6>;
constexpr Zeros kNoZeros{-1, -1, -1, -1, -1, -1};

/// Of what is open in a cell: the tree without the questions that have one answer all over it. Depth first,
/// the high child next to its parent.
struct OpenNode {
    std::int32_t question = -1;  ///< -1: a leaf
    std::int32_t low = 0;        ///< how far on the low child stands; of a leaf: its node of the whole tree
};

struct TreeCells {
    std::vector<Vec3> position;
    std::vector<Zeros> zeros;  ///< by vertex
    /// Where there is none, the tree says the same all around. Their `node` is the root of what is open in
    /// them; once they are cut, their leaf of the whole tree.
    std::vector<Tetrahedron> cells;
    std::vector<OpenNode> open;

    /// Of a vertex from a question's zero set, to first order; positive on the high side.
    double distance(const TreePruner& tree, std::int32_t vertex, std::int32_t question) const;
};

/// Cells near the surface, fine enough for its questions to be flat in them to within `chord`.
TreeCells cells_near_surface(const TreePruner& tree, const PolygonizeOptions& options, double chord,
                             const Task& task);

/// Cuts the cells by the questions until each ends in a leaf, its `node`. Vertices closer than `snap` to a
/// question's zero set count as on it.
void cut_cells(const TreePruner& tree, double snap, std::size_t max_cells, TreeCells& cells,
               const Task& task);

}  // namespace pfgeom
