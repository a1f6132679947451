// The surface of a solid between tetrahedra: a conforming partition of the space near it, each of whose parts
// lies on one side of every question that matters there.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/polygonize/cut_solid.h"
#include "pfgeom/polygonize/polygonize.h"
#include "pfgeom/polygonize/tetrahedra.h"

#include <span>

namespace pfgeom {

/// Questions on whose zero sets a vertex has been put; -1 fills up. More than six are not remembered.
using Zeros = std::array<std::int32_t, 6>;
constexpr Zeros kNoZeros{-1, -1, -1, -1, -1, -1};

/// Of what is open in a cell: the solid without the questions that have one answer all over it. In the order
/// of SolidNode.
struct OpenNode {
    std::int32_t question = SolidNode::kLeaf;  ///< as SolidNode's
    std::int32_t low = 0;  ///< how far on the low child or second operand stands; of a leaf: its SolidNode
};

/// What the solid says in a cell, and which of its leaves say so.
struct CellAnswer {
    bool inside = false;
    std::span<const std::int32_t> leaves;
};

struct TreeCells {
    std::vector<Vec3> position;
    std::vector<Zeros> zeros;  ///< by vertex
    /// Where there is none, the solid says the same all around. Their `node` is the root of what is open in
    /// them; once they are cut, their leaf, or a row of `leaves` if the solid is combined.
    std::vector<Tetrahedron> cells;
    std::vector<OpenNode> open;
    std::vector<std::int32_t> leaves;  ///< of cells: 2 · number + (1 if inside), then so many

    /// Of a vertex from a question's zero set, to first order; positive on the high side.
    double distance(const CutSolid& solid, std::int32_t vertex, std::int32_t question) const;
    /// Of a cell that has been cut.
    CellAnswer answer(const CutSolid& solid, const Tetrahedron& cell) const;
};

/// Cells near the surface, fine enough for its questions to be flat in them to within `chord`.
TreeCells cells_near_surface(const CutSolid& solid, const PolygonizeOptions& options, double chord,
                             const Task& task);

/// Cuts the cells by the questions until each ends in a leaf, its `node`. Vertices closer than `snap` to a
/// question's zero set count as on it.
void cut_cells(const CutSolid& solid, double snap, std::size_t max_cells, TreeCells& cells, const Task& task);

}  // namespace pfgeom
