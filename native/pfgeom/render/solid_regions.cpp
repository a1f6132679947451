#include "pfgeom/render/solid_regions.h"

#include <array>
#include <cstdint>

namespace pfgeom {
namespace {

using Kind = SetNode::Kind;
using Regions = std::vector<SignRegion>;

// What a leaf of an octree is left with is some functions; more regions than this are bounded as one.
constexpr std::size_t kMostRegions = 64;

Regions one(std::int32_t function, bool positive) {
    SignRegion region;
    region.add({function, positive ? Sense::positive : Sense::negative});
    return {region};
}

Regions either(Regions a, const Regions& b) {
    if (a.size() + b.size() > kMostRegions) return {SignRegion{}};
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Regions both(const Regions& a, const Regions& b) {
    if (a.size() * b.size() > kMostRegions) return a.size() < b.size() ? a : b;
    Regions all;
    for (const SignRegion& first : a) {
        for (const SignRegion& second : b) {
            SignRegion region = first;
            for (std::size_t i = 0; i < second.count; ++i) region.add(second.conditions[i]);
            all.push_back(region);
        }
    }
    return all;
}

// Of both sides of a node, from those of the nodes before it.
class Parts {
  public:
    void add(const SetNode& node) {
        for (const bool inside : {false, true}) of_[inside ? 1 : 0].push_back(part(node, inside));
    }
    const Regions& at(std::int32_t node, bool inside) const {
        return of_[inside ? 1 : 0][static_cast<std::size_t>(node)];
    }

  private:
    Regions part(const SetNode& node, bool inside) const {
        switch (node.kind) {
            case Kind::function:
                return one(node.a, inside);
            case Kind::unite:
            case Kind::intersect:
                if ((node.kind == Kind::unite) == inside)
                    return either(at(node.a, inside), at(node.b, inside));
                return both(at(node.a, inside), at(node.b, inside));
            case Kind::complement:
                return at(node.a, !inside);
            case Kind::decide:
                return either(both(one(node.f, true), at(node.a, inside)),
                              both(one(node.f, false), at(node.b, inside)));
            case Kind::inside:
                return inside ? Regions{SignRegion{}} : Regions{};
            case Kind::outside:
                break;
        }
        return inside ? Regions{} : Regions{SignRegion{}};
    }

    std::array<std::vector<Regions>, 2> of_;
};

}  // namespace

void regions_of(std::span<const SetNode> nodes, bool inside, std::vector<SignRegion>& regions) {
    if (nodes.size() == 1 && nodes[0].kind == Kind::function) {
        regions = one(nodes[0].a, inside);
        return;
    }
    Parts parts;
    for (const SetNode& node : nodes) parts.add(node);
    regions = parts.at(static_cast<std::int32_t>(nodes.size()) - 1, inside);
}

}  // namespace pfgeom
