#include "pfgeom/function/set_tree.h"

#include "pfgeom/function/quadric_family.h"

#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

const TreeNode& node_at(const SetTree& tree, std::int32_t index) {
    return tree.nodes[static_cast<std::size_t>(index)];
}

bool says_high(const SetTree& tree, const TreeNode& node, const Vec3& p) {
    if (node.kind == TreeNode::Kind::cut) return p[node.axis] >= node.cut;
    return tree.quadrics[static_cast<std::size_t>(node.quadric)].quadric.value(p) >= 0;
}

}  // namespace

Box SetTree::box() const {
    const double unit = std::ldexp(1.0, -(resolution + 1));
    return {{low[0] * unit, low[1] * unit, low[2] * unit}, {high[0] * unit, high[1] * unit, high[2] * unit}};
}

bool contains(const SetTree& tree, const Vec3& p) {
    if (tree.nodes.empty() || !tree.box().contains(p)) return false;
    const TreeNode* node = &tree.nodes[0];
    while (!node->leaf()) node = &node_at(tree, says_high(tree, *node, p) ? node->high : node->low);
    return node->kind == TreeNode::Kind::inside;
}

double cut_position(const TreeNode& node, const Box& cell) {
    const double low = cell.lo[node.axis], high = cell.hi[node.axis];
    return low + (high - low) * node.position / (node.fine ? kFineCuts : kCoarseCuts);
}

Box high_cell(const TreeNode& node, const Box& cell) {
    Box result = cell;
    if (node.kind == TreeNode::Kind::cut) result.lo[node.axis] = node.cut;
    return result;
}

Box low_cell(const TreeNode& node, const Box& cell) {
    Box result = cell;
    if (node.kind == TreeNode::Kind::cut) result.hi[node.axis] = node.cut;
    return result;
}

void derive(SetTree& tree) {
    for (TreeQuadric& q : tree.quadrics) q.quadric = expand(q, tree.resolution);
    if (tree.nodes.empty()) return;
    struct Place {
        std::int32_t node;
        Box cell;
    };
    std::vector<Place> open{{0, tree.box()}};
    while (!open.empty()) {
        const Place at = open.back();
        open.pop_back();
        TreeNode& node = tree.nodes[static_cast<std::size_t>(at.node)];
        if (node.leaf()) continue;
        if (node.kind == TreeNode::Kind::cut) node.cut = cut_position(node, at.cell);
        open.push_back({node.low, low_cell(node, at.cell)});
        open.push_back({node.high, high_cell(node, at.cell)});
    }
}

}  // namespace pfgeom
