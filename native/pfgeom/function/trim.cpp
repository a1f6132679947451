#include "pfgeom/function/trim.h"

namespace pfgeom {
namespace {

using Kind = SetNode::Kind;

// Set operations, and no decisions, so that the expression's value has no jumps.
class TrimMaker {
  public:
    explicit TrimMaker(const MaterialTree& tree) : tree_(tree) {}

    Trim run() {
        add(0);
        return std::move(trim_);
    }

  private:
    // Recursion as deep as the tree, at most kMaxMaterialDepth.
    std::int32_t add(std::int32_t row) {
        const MaterialNode& node = at(row);
        if (node.leaf()) return push({is_kept(node) ? Kind::inside : Kind::outside});
        const MaterialNode &high = at(node.high), &low = at(node.low);
        const std::int32_t plane = add_plane(node);
        if (high.leaf() && low.leaf() && is_kept(high) && !is_kept(low)) return plane;
        const std::int32_t above = part(node.high, plane), below = part(node.low, complement(plane));
        return push({Kind::unite, above, below});
    }

    std::int32_t part(std::int32_t row, std::int32_t side) {
        if (at(row).leaf() && is_kept(at(row))) return side;
        const std::int32_t of_side = add(row);
        return push({Kind::intersect, side, of_side});
    }

    std::int32_t complement(std::int32_t node) { return push({Kind::complement, node}); }

    std::int32_t add_plane(const MaterialNode& node) {
        Function plane;
        plane.base.c = {0, 0, 0, 0, 0, 0, node.normal.x, node.normal.y, node.normal.z, -node.level};
        trim_.functions.push_back(plane);
        return push({Kind::function, static_cast<std::int32_t>(trim_.functions.size()) - 1});
    }

    std::int32_t push(SetNode node) {
        trim_.nodes.push_back(node);
        return static_cast<std::int32_t>(trim_.nodes.size()) - 1;
    }

    const MaterialNode& at(std::int32_t row) const { return tree_.nodes[static_cast<std::size_t>(row)]; }
    static bool is_kept(const MaterialNode& leaf) { return leaf.material == Sheet::kKept; }

    const MaterialTree& tree_;
    Trim trim_;
};

}  // namespace

Trim trim_of(const Model& model, const Sheet& sheet) {
    if (sheet.trim < 0) return TrimMaker(sheet.cut).run();
    return {{model.functions[static_cast<std::size_t>(sheet.trim)]}, {{Kind::function, 0}}};
}

void append_trim(const Trim& trim, std::int32_t first, std::vector<SetNode>& nodes) {
    const auto before = static_cast<std::int32_t>(nodes.size());
    for (SetNode node : trim.nodes) {
        if (node.kind == Kind::function) {
            node.a += first;
        } else {
            node.a += node.a >= 0 ? before : 0;
            node.b += node.b >= 0 ? before : 0;
        }
        nodes.push_back(node);
    }
}

}  // namespace pfgeom
