#include "pfgeom/polygonize/cut_solid.h"

#include <algorithm>
#include <utility>

namespace pfgeom {

CutSolid::CutSolid(const TreePruner& tree) {
    for (std::size_t i = 0; i < tree.questions(); ++i) add(tree.quadric(static_cast<std::int32_t>(i)));
    for (const PrunedNode& node : tree.whole()) nodes_.push_back({node.question, node.low, node.inside});
}

std::int32_t CutSolid::add(const Quadric& question) {
    quadrics_.push_back(question);
    fields_.emplace_back();
    return static_cast<std::int32_t>(quadrics_.size()) - 1;
}

std::int32_t CutSolid::add(SmoothQuestion question) {
    quadrics_.emplace_back();
    fields_.push_back(std::move(question));
    return static_cast<std::int32_t>(quadrics_.size()) - 1;
}

void CutSolid::finish() {
    combined_ = std::any_of(nodes_.begin(), nodes_.end(),
                            [](const SolidNode& node) { return node.question < SolidNode::kLeaf; });
}

// The first operand that settles an operation speaks for it.
bool CutSolid::contains(std::int32_t node, const Vec3& p, std::vector<std::int32_t>& leaves) const {
    while (nodes_[node].question >= 0)
        node = value(nodes_[node].question, p) >= 0 ? node + 1 : nodes_[node].low;
    const SolidNode& n = nodes_[node];
    if (n.question == SolidNode::kLeaf) {
        leaves.push_back(node);
        return n.inside;
    }
    const std::size_t before = leaves.size();
    const bool first = contains(node + 1, p, leaves);
    if (n.question == SolidNode::kComplement) return !first;
    const bool settles = n.question == SolidNode::kUnite;
    if (first == settles) return settles;
    const std::size_t between = leaves.size();
    if (contains(n.low, p, leaves) != settles) return !settles;
    leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(before),
                 leaves.begin() + static_cast<std::ptrdiff_t>(between));
    return settles;
}

}  // namespace pfgeom
