#include "pfgeom/render/ray_octree.h"

namespace pfgeom {
namespace {

void add_cells(const RayOctree& tree, std::int32_t cell, const Box& box, int depth, std::vector<Box>& cells) {
    if (cell == RayOctree::kOutside) return;
    if (cell < 0 || depth == 0) {
        cells.push_back(box);
        return;
    }
    const auto& children = tree.nodes[static_cast<std::size_t>(cell)];
    for (unsigned place = 0; place < 8; ++place)
        add_cells(tree, children[place], child_box(box, place), depth - 1, cells);
}

}  // namespace

std::vector<Box> cover_in(const CubePlace& place, const RayOctree& tree) {
    constexpr int kDepth = 4;
    std::vector<Box> cells;
    add_cells(tree, tree.root, tree.box, kDepth, cells);
    for (Box& cell : cells) cell = {place.to_world(cell.lo), place.to_world(cell.hi)};
    return cells;
}

}  // namespace pfgeom
