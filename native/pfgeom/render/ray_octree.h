// An octree whose leaves know the little that can be the surface in them, and the walk of a ray through it,
// front to back.
//
// Source: Revelles, Ureña, Lastra, "An efficient parametric algorithm for octree traversal", 2000.
// Departures: children are told from the sides of the middle planes that the ray is on, instead of from a
// table; axes that the ray does not move along are given a step that is too small to matter.
//
// Watertight: the spans of neighbouring cells along a ray end at the same number, each leaf looks a little
// further than its span, and what a leaf knows holds a little around its cell (kReach).
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/render/local_ray.h"
#include "pfgeom/render/ray.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace pfgeom {

/// How far around its cell a leaf is right, and how far around a span it is asked, in the cube's units.
/// Points on rays are computed to 1e-15.
constexpr double kReach = 1e-9, kLookAround = 1e-11;

/// Cells are numbered: kOutside and kInside have no surface in them; then leaves from kFirstLeaf down; inner
/// nodes from 0 up.
struct RayOctree {
    static constexpr std::int32_t kOutside = -1, kInside = -2, kFirstLeaf = -3;

    Box box;
    std::int32_t root = kOutside;
    std::vector<std::array<std::int32_t, 8>> nodes;  ///< children; bit `axis` of the place: the upper half

    static std::int32_t leaf_of(std::int32_t cell) { return kFirstLeaf - cell; }
    static bool is_leaf(std::int32_t cell) { return cell <= kFirstLeaf; }
};

inline Box child_box(const Box& box, unsigned place) {
    const Vec3 middle = box.centre();
    Box child = box;
    for (int axis = 0; axis < 3; ++axis) (place >> axis & 1U ? child.lo : child.hi)[axis] = middle[axis];
    return child;
}

/// The cells that are not outside, in the world; not divided below a depth of 4.
std::vector<Box> cover_in(const CubePlace& place, const RayOctree& tree);

/// One ray's way through an octree. visit(cell, span) is called for the cells that are not kOutside, in
/// order, until it returns true.
template <class Visit>
class OctreeWalk {
  public:
    OctreeWalk(const RayOctree& tree, const Ray& ray, const RaySpan& span, Visit visit)
        : tree_(tree), span_(span), visit_(std::move(visit)) {
        const Vec3& d = ray.direction;
        const double least = 1e-30 * std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        for (int axis = 0; axis < 3; ++axis) {
            const double step = std::abs(d[axis]) > least ? d[axis] : least;
            const bool falls = step < 0;
            if (falls) mirror_ |= 1U << axis;
            near_[axis] = ((falls ? tree.box.hi : tree.box.lo)[axis] - ray.origin[axis]) / step;
            far_[axis] = ((falls ? tree.box.lo : tree.box.hi)[axis] - ray.origin[axis]) / step;
        }
    }

    double enters() const { return std::max({near_.x, near_.y, near_.z}); }
    double leaves() const { return std::min({far_.x, far_.y, far_.z}); }
    /// The axis across which the ray enters or leaves the box.
    int entry_axis() const {
        return near_.x >= near_.y && near_.x >= near_.z ? 0 : near_.y >= near_.z ? 1 : 2;
    }
    int exit_axis() const { return far_.x <= far_.y && far_.x <= far_.z ? 0 : far_.y <= far_.z ? 1 : 2; }

    bool run() { return enters() <= leaves() && walk(tree_.root, near_, far_); }

  private:
    bool walk(std::int32_t cell, const Vec3& near, const Vec3& far) {
        if (cell == RayOctree::kOutside) return false;
        const double from = std::max({near.x, near.y, near.z, span_.from});
        const double to = std::min({far.x, far.y, far.z, span_.to});
        if (!(from <= to)) return false;
        if (cell < 0) return visit_(cell, RaySpan{from, to});

        const auto& children = tree_.nodes[static_cast<std::size_t>(cell)];
        const Vec3 middle = (near + far) * 0.5;
        unsigned place = 0;
        for (int axis = 0; axis < 3; ++axis) place |= middle[axis] < from ? 1U << axis : 0U;
        for (;;) {
            Vec3 lo = near, hi = far;
            int exit = 0;
            for (int axis = 0; axis < 3; ++axis) {
                (place >> axis & 1U ? lo : hi)[axis] = middle[axis];
                if (hi[axis] < hi[exit]) exit = axis;
            }
            if (walk(children[place ^ mirror_], lo, hi)) return true;
            if ((place >> exit & 1U) != 0 || hi[exit] > to) return false;
            place |= 1U << exit;
        }
    }

    const RayOctree& tree_;
    RaySpan span_;
    Visit visit_;
    Vec3 near_, far_;  // where the ray crosses the box's six planes
    unsigned mirror_ = 0;
};

/// The unit vector of a gradient, turned to the side that `outwards` points to; without a gradient, that
/// side.
inline Vec3 along(const Vec3& gradient, const Vec3& outwards) {
    const Vec3 n = normalized(gradient);
    if (!(squared_norm(n) > 0.5)) return normalized(outwards);
    return dot(n, outwards) < 0 ? -n : n;
}

/// What a leaf says of a span of a ray: is its beginning inside, where is the first change of sides, if any.
/// Of the hit's normal only the side is asked: `along` the ray, or against it.
struct LeafAnswer {
    bool begins_inside = false, ends_inside = false;  // `ends`: meaningful without a hit
    SurfaceHit hit;
};

/// The first hit of what the octree holds, which is empty outside of the octree's box: the box's sides are
/// surface where they close an inside. ask(leaf, span).
template <class Ask>
SurfaceHit first_hit_in(const RayOctree& tree, const Ray& ray, const RaySpan& span, Ask ask) {
    SurfaceHit hit;
    const double speed = norm(ray.direction), around = kLookAround / speed;
    double inside_until = -std::numeric_limits<double>::infinity();
    double enters = 0;
    int entry_axis = 0;
    const auto side_hit = [&](double t, int axis, bool entering) {
        Vec3 normal;
        normal[axis] = (ray.direction[axis] > 0) == entering ? -1 : 1;
        return SurfaceHit{t, normal, -1, -1};
    };
    const auto visit = [&](std::int32_t cell, const RaySpan& part) {
        LeafAnswer answer{true, true, {}};
        if (RayOctree::is_leaf(cell)) {
            const RaySpan wide{std::max(part.from - around, span.from), std::min(part.to + around, span.to)};
            answer = ask(RayOctree::leaf_of(cell), wide);
        }
        if (answer.begins_inside && part.from <= enters) {
            hit = side_hit(enters, entry_axis, true);
        } else {
            hit = answer.hit;
            inside_until = answer.ends_inside ? part.to : inside_until;
        }
        return hit.found();
    };
    OctreeWalk walk(tree, ray, span, visit);
    enters = walk.enters();
    if (enters < span.from) enters = -std::numeric_limits<double>::infinity();
    entry_axis = walk.entry_axis();
    if (!walk.run() && inside_until >= walk.leaves() && walk.leaves() < span.to)
        hit = side_hit(walk.leaves(), walk.exit_axis(), false);
    return hit;
}

}  // namespace pfgeom
