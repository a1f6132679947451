// Set trees for the tests of the polygonizer, put together from half spaces, balls, cylinders and cones.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/function/set_tree.h"

#include <memory>

namespace pfgeom::test {

/// A region of space as a decision tree of its own; null high and low: a leaf.
struct Region {
    bool inside = false;
    Quadric question;
    std::shared_ptr<const Region> high, low;
};
using RegionPtr = std::shared_ptr<const Region>;

inline RegionPtr leaf(bool inside) {
    return std::make_shared<const Region>(Region{inside, {}, nullptr, nullptr});
}
inline RegionPtr ask(const Quadric& question, RegionPtr high, RegionPtr low) {
    return std::make_shared<const Region>(Region{false, question, std::move(high), std::move(low)});
}
inline RegionPtr where(const Quadric& positive) {
    return ask(positive, leaf(true), leaf(false));
}

/// `region` with other trees in place of its leaves.
inline RegionPtr with_leaves(const RegionPtr& region, const RegionPtr& inside, const RegionPtr& outside) {
    if (!region->high) return region->inside ? inside : outside;
    return ask(region->question, with_leaves(region->high, inside, outside),
               with_leaves(region->low, inside, outside));
}
inline RegionPtr both(const RegionPtr& a, const RegionPtr& b) {
    return with_leaves(a, b, leaf(false));
}
inline RegionPtr either(const RegionPtr& a, const RegionPtr& b) {
    return with_leaves(a, leaf(true), b);
}
inline RegionPtr without(const RegionPtr& a, const RegionPtr& b) {
    return with_leaves(a, with_leaves(b, leaf(false), leaf(true)), leaf(false));
}

/// dot(n, x) <= offset
inline Quadric half_space(const Vec3& n, double offset) {
    return {{0, 0, 0, 0, 0, 0, -n.x, -n.y, -n.z, offset}};
}
/// Within `radius` of the centre, measured across `axis` (a unit vector; none: a ball) and shrinking along it
/// by `taper` (a cone). The slope is 1 on a ball and on a cylinder.
inline Quadric turned(const Vec3& centre, double radius, const Vec3& axis = {}, double taper = 0) {
    // (r - t s)² - |x-c|² + s², with s = axis · (x-c), over 2 r
    const double k = squared_norm(axis) * (1 + taper * taper);
    Quadric q;
    auto& c = q.c;
    c = {k * axis.x * axis.x - 1,
         k * axis.y * axis.y - 1,
         k * axis.z * axis.z - 1,
         2 * k * axis.x * axis.y,
         2 * k * axis.x * axis.z,
         2 * k * axis.y * axis.z,
         0,
         0,
         0,
         0};
    const Vec3 curl = q.gradient(centre);
    const Vec3 slope = -curl - axis * (2 * radius * taper);
    c[6] = slope.x, c[7] = slope.y, c[8] = slope.z;
    c[9] = 0;
    c[9] = radius * radius - q.value(centre);
    for (double& x : c) x /= 2 * radius;
    return q;
}
inline RegionPtr box(const Vec3& lo, const Vec3& hi) {
    RegionPtr region = leaf(true);
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 n;
        n[axis] = 1;
        region = both(both(where(half_space(n, hi[axis])), where(half_space(-n, -lo[axis]))), region);
    }
    return region;
}

inline RegionPtr random_region(Random& random, int depth) {
    if (depth == 0) return leaf(random.below(2) != 0);
    const auto any = [&] { return 2 * random.uniform() - 1; };
    const Vec3 p{any(), any(), any()}, n = normalized({any(), any(), any()});
    Quadric q;
    switch (random.below(6)) {
        case 0:
            q = half_space(n, 0.6 * any());
            break;
        case 1:
            q = half_space({0, 0, 1}, static_cast<double>(random.below(17)) / 16 - 0.5);
            break;  // on the grid
        case 2:
            q = turned(p, 0.2 + 0.4 * random.uniform());
            break;
        case 3:
            q = turned(p, 0.1 + 0.3 * random.uniform(), n);
            break;
        case 4:
            q = turned(p, 0.1 + 0.3 * random.uniform(), n, any());
            break;
        default:
            for (double& c : q.c) c = any();
    }
    return ask(q, random_region(random, depth - 1 - static_cast<int>(random.below(2)) * (depth > 1)),
               random_region(random, depth - 1));
}

/// As a set tree whose box is the whole cube.
inline SetTree tree_of(const RegionPtr& region) {
    SetTree tree;
    tree.low.fill(-(1 << (tree.resolution + 1)));
    tree.high.fill(1 << (tree.resolution + 1));
    const auto add = [&](const auto& self, const RegionPtr& r) -> std::int32_t {
        const auto at = static_cast<std::int32_t>(tree.nodes.size());
        tree.nodes.emplace_back();
        TreeNode node;
        node.kind = r->inside ? TreeNode::Kind::inside : TreeNode::Kind::outside;
        if (r->high) {
            node.kind = TreeNode::Kind::ask;
            node.quadric = static_cast<std::int32_t>(tree.quadrics.size());
            tree.quadrics.push_back({.quadric = r->question});
            node.high = self(self, r->high);
            node.low = self(self, r->low);
        }
        tree.nodes[static_cast<std::size_t>(at)] = node;
        return at;
    };
    add(add, region);
    return tree;
}

}  // namespace pfgeom::test
