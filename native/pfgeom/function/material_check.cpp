#include "pfgeom/base/utf8.h"
#include "pfgeom/function/check.h"

#include <algorithm>
#include <cstdlib>

namespace pfgeom {
namespace {

using Flaw = std::string;  // empty: none

Flaw flaw_of(const MaterialNode& node, std::size_t materials) {
    if (node.leaf()) {
        const bool exists = node.material >= 0 && static_cast<std::size_t>(node.material) < materials;
        return exists ? Flaw{} : "a leaf's material does not exist";
    }
    if (node.axis > 2 || node.bits > kMostPlaneBits)
        return "a plane's axis or number of bits is out of range";
    const std::int32_t one = 1 << node.bits;
    if (std::abs(node.tilt[0]) > one || std::abs(node.tilt[1]) > one ||
        std::abs(node.offset) >= (node.is_cut() ? one : 3 * one)) {
        return "a plane's tilt or offset is out of range";
    }
    return {};
}

Flaw flaw_of(const Paint& paint, const Object& object, std::size_t materials) {
    const auto* tree = std::get_if<SetTree>(&object.shape);
    if (paint.by_quadric && (tree == nullptr || tree->quadrics.empty()))
        return "there are no quadrics to paint by";
    if (paint.trees.size() != (paint.by_quadric ? tree->quadrics.size() : 1))
        return "there are too few or too many trees";
    for (const MaterialTree& t : paint.trees) {
        if (Flaw flaw = find_flaw(t, materials); !flaw.empty()) return flaw;
    }
    return {};
}

}  // namespace

// Walks depth first, the high child first: the rows must come in that order.
std::string find_flaw(const MaterialTree& tree, std::size_t materials) {
    std::vector<std::pair<std::int32_t, int>> open{{0, 0}};  // row, depth
    for (std::size_t row = 0; row < tree.nodes.size(); ++row) {
        if (open.empty() || open.back().first != static_cast<std::int32_t>(row))
            return "nodes are not in order";
        const int depth = open.back().second;
        open.pop_back();
        const MaterialNode& node = tree.nodes[row];
        if (Flaw flaw = flaw_of(node, materials); !flaw.empty()) return flaw;
        if (node.leaf()) continue;
        if (depth >= kMaxMaterialDepth) return "a path asks too many questions";
        open.emplace_back(node.low, depth + 1);
        open.emplace_back(node.high, depth + 1);
    }
    return tree.nodes.empty() || !open.empty() ? "nodes are missing" : "";
}

std::string find_flaw_of_materials(const Model& model, const Limits& limits) {
    const MaterialMap& map = model.materials;
    if (map.empty()) return map.names.empty() ? "" : "there are names of materials, but no materials";
    if (map.objects.size() != model.objects.size()) return "not every object has materials";
    if (map.names.empty() || map.names.size() > limits.materials) return "there are no or too many materials";
    for (const std::string& name : map.names) {
        if (name.size() > limits.string_bytes || !is_utf8(name))
            return "a material's name is too long or not UTF-8";
    }
    for (std::size_t i = 0; i < map.objects.size(); ++i) {
        const std::size_t n = map.objects[i].size();
        const std::string row = "materials of object " + std::to_string(i) + ": ";
        if (n != 1 && n != copy_count(model.objects[i])) return row + "not one for each copy";
        for (const Paint& paint : map.objects[i]) {
            if (Flaw flaw = flaw_of(paint, model.objects[i], map.names.size()); !flaw.empty())
                return row + flaw;
        }
    }
    return {};
}

}  // namespace pfgeom
