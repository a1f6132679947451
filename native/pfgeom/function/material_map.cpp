#include "pfgeom/function/material_map.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

double half_side(const Box& cell) {
    const Vec3 size = cell.extent();
    return std::max({size.x, size.y, size.z}) / 2;
}

}  // namespace

Box root_cell() {
    return {{-1, -1, -1}, {1, 1, 1}};
}

Box high_cell(const MaterialNode& plane, const Box& cell) {
    Box high = cell;
    if (plane.is_cut())
        high.lo[plane.axis] = std::clamp(plane.level, cell.lo[plane.axis], cell.hi[plane.axis]);
    return high;
}

Box low_cell(const MaterialNode& plane, const Box& cell) {
    Box low = cell;
    if (plane.is_cut())
        low.hi[plane.axis] = std::clamp(plane.level, cell.lo[plane.axis], cell.hi[plane.axis]);
    return low;
}

void derive(MaterialNode& plane, const Box& cell) {
    const double unit = std::ldexp(1.0, -plane.bits);
    const int u = (plane.axis + 1) % 3, v = (plane.axis + 2) % 3;
    plane.normal = {};
    plane.normal[plane.axis] = 1;
    plane.normal[u] = plane.tilt[0] * unit;
    plane.normal[v] = plane.tilt[1] * unit;
    plane.level = dot(plane.normal, cell.centre()) + half_side(cell) * (plane.offset * unit);
}

std::int32_t material_at(const MaterialTree& tree, const Vec3& p) {
    const MaterialNode* node = tree.nodes.data();
    while (!node->leaf()) {
        const std::int32_t next = dot(node->normal, p) >= node->level ? node->high : node->low;
        node = &tree.nodes[static_cast<std::size_t>(next)];
    }
    return node->material;
}

Paint plain_paint(std::int32_t material) {
    MaterialNode leaf;
    leaf.material = material;
    return {{{{leaf}}}, false};
}

}  // namespace pfgeom
