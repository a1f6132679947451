// A hierarchy of boxes for rays: which of many things a ray may meet, the nearest first.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/render/ray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// A ray made ready for tests against boxes.
class BoxRay {
  public:
    explicit BoxRay(const Ray& ray) : origin_(ray.origin) {
        const Vec3& d = ray.direction;
        const double least = 1e-30 * std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        for (int axis = 0; axis < 3; ++axis)
            inverse_[axis] = 1 / (std::abs(d[axis]) > least ? d[axis] : least);
    }
    /// The part of the span within the box; empty (from > to) if there is none.
    RaySpan within(const Box& box, const RaySpan& span) const {
        RaySpan part = span;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (box.lo[axis] - origin_[axis]) * inverse_[axis];
            const double b = (box.hi[axis] - origin_[axis]) * inverse_[axis];
            part.from = std::max(part.from, std::min(a, b));
            part.to = std::min(part.to, std::max(a, b));
        }
        return part;
    }

  private:
    Vec3 origin_, inverse_;
};

class BoxTree {
  public:
    BoxTree() = default;
    explicit BoxTree(std::span<const Box> boxes);

    /// visit(row of the boxes, span) for those that the ray meets in the span; it may shorten span.to.
    template <class Visit>
    void walk(const Ray& ray, RaySpan& span, Visit visit) const {
        if (!nodes_.empty()) walk(0, BoxRay(ray), span, visit);
    }

    /// visit(row of the boxes) for those nearer to p than `within`, the nearest first at each fork; it may
    /// lower `within`.
    template <class Visit>
    void walk_near(const Vec3& p, double& within, Visit visit) const {
        if (!nodes_.empty()) walk_near(0, p, within, visit);
    }

  private:
    // An inner node's children are `first` and `first` + 1.
    struct Node {
        Box box;
        std::int32_t first = -1, item = -1;  // item: of a leaf
    };
    void split(std::int32_t node, std::span<std::int32_t> items, std::span<const Box> boxes);

    template <class Visit>
    void walk(std::int32_t index, const BoxRay& ray, RaySpan& span, Visit& visit) const {
        const Node& node = nodes_[static_cast<std::size_t>(index)];
        if (node.item >= 0) {
            visit(node.item, span);
            return;
        }
        const auto first = static_cast<std::size_t>(node.first);
        const RaySpan a = ray.within(nodes_[first].box, span), b = ray.within(nodes_[first + 1].box, span);
        const bool swap = b.from < a.from;
        for (const bool second : {swap, !swap}) {
            const RaySpan& part = second ? b : a;
            if (part.from <= part.to && part.from <= span.to)
                walk(node.first + (second ? 1 : 0), ray, span, visit);
        }
    }

    template <class Visit>
    void walk_near(std::int32_t index, const Vec3& p, double& within, Visit& visit) const {
        const Node& node = nodes_[static_cast<std::size_t>(index)];
        if (!(std::sqrt(node.box.squared_distance(p)) < within)) return;
        if (node.item >= 0) {
            visit(node.item);
            return;
        }
        const auto first = static_cast<std::size_t>(node.first);
        const double a = nodes_[first].box.squared_distance(p), b = nodes_[first + 1].box.squared_distance(p);
        const int nearer = b < a ? 1 : 0;
        for (const int child : {nearer, 1 - nearer}) walk_near(node.first + child, p, within, visit);
    }

    std::vector<Node> nodes_;
};

}  // namespace pfgeom
