#include "pfgeom/function/model.h"

namespace pfgeom {

Solid without_outer_complement(const Solid& solid) {
    Solid inner = solid;
    if (!inner.nodes.empty() && inner.nodes.back().kind == SetNode::Kind::complement &&
        inner.nodes.back().a == static_cast<std::int32_t>(inner.nodes.size()) - 2) {
        inner.nodes.pop_back();
    }
    return inner;
}

std::vector<Similarity> copies_of(const Object& object) {
    std::vector<Similarity> copies;
    const Placements& p = object.placements;
    for (std::size_t i = 0; i < p.list.size(); ++i) copies.push_back(p.similarity(i, object.frame.centre()));
    if (!p.empty()) return copies;
    copies.emplace_back();
    copies.insert(copies.end(), object.instances.begin(), object.instances.end());
    return copies;
}

std::size_t copy_count(const Object& object) {
    return object.placements.empty() ? 1 + object.instances.size() : object.placements.list.size();
}

}  // namespace pfgeom
