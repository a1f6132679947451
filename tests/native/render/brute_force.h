// The slow twin of raycast: many steps along the ray, then bisection.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/render/ray_target.h"

#include <gtest/gtest.h>

#include <functional>

namespace pfgeom::test {

inline Vec3 any_point(Random& random, double reach = 1) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = reach * (2 * random.uniform() - 1);
    return p;
}

using Inside = std::function<bool(const Vec3&)>;

/// The first change of sides among so many steps; infinity if there is none.
inline double first_change(const Inside& inside, const Ray& ray, double until, int steps) {
    const bool begins = inside(ray.at(0));
    for (int i = 1; i <= steps; ++i) {
        double lo = until * (i - 1) / steps, hi = until * i / steps;
        if (inside(ray.at(hi)) == begins) continue;
        while (hi - lo > 1e-13 && lo + (hi - lo) / 2 > lo && lo + (hi - lo) / 2 < hi) {
            const double middle = lo + (hi - lo) / 2;
            (inside(ray.at(middle)) == begins ? lo : hi) = middle;
        }
        return hi;
    }
    return Box::kInf;
}

/// From around a box into any direction, some along an axis and through planes that halve the box.
inline Ray random_ray(Random& random, const Box& box) {
    const auto point = [&] {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform() * 1.4 - 0.2;
        if (random.below(8) == 0)
            p[static_cast<int>(random.below(3))] = 0.25 * static_cast<double>(1 + random.below(3));
        const Vec3 e = box.extent();
        return box.lo + Vec3{e.x * p.x, e.y * p.y, e.z * p.z};
    };
    const Vec3 from = point();
    Vec3 along = normalized(point() - from);
    if (random.below(8) == 0) {
        const int axis = static_cast<int>(random.below(3));
        along = {};
        along[axis] = random.below(2) == 0 ? 1 : -1;
    }
    return {from, along};
}

struct Comparison {
    int hits = 0, missed = 0, untrue = 0;
};

/// Rays of a target against the slow twin. Missed: the twin finds an earlier change, and the ray's neighbours
/// at a distance of 1e-9 do not find it either (else the ray touches). Untrue: there is no change of sides,
/// or the normal does not point outwards.
inline Comparison compare(const RayTarget& target, const Inside& inside, const Box& box, std::uint64_t seed,
                          int rays, int steps) {
    Random random(seed);
    Comparison found;
    const double size = box.diagonal(), tiny = 1e-9 * size;
    for (int i = 0; i < rays; ++i) {
        const Ray ray = random_ray(random, box);
        const SurfaceHit hit = target.first_hit(ray, {});
        const double twin = first_change(inside, ray, std::min(hit.t, 1.8 * size), steps);
        if (twin < hit.t - tiny) {
            bool touches = false;
            for (int axis = 0; axis < 6; ++axis) {
                Vec3 aside;
                aside[axis / 2] = axis % 2 == 0 ? tiny : -tiny;
                const SurfaceHit near = target.first_hit({ray.origin + aside, ray.direction}, {});
                touches = touches || std::abs(near.t - twin) < 1e-4 * size;
            }
            if (!touches) ++found.missed;
        }
        if (!hit.found()) continue;
        ++found.hits;
        const bool before = inside(ray.at(hit.t - tiny)), after = inside(ray.at(hit.t + tiny));
        const double slope = dot(hit.normal, ray.direction);
        const bool outwards = before ? slope > -1e-9 : slope < 1e-9;
        if (before == after || !outwards || std::abs(norm(hit.normal) - 1) > 1e-9) ++found.untrue;
    }
    return found;
}

}  // namespace pfgeom::test
