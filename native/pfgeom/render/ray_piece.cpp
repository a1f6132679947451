#include "pfgeom/render/ray_piece.h"

#include "pfgeom/function/moved_box.h"

#include <limits>

namespace pfgeom {

SurfaceHit RayPiece::first_hit(const Ray& ray, const RaySpan& span) const {
    const Ray own = is_moved ? Ray{back.apply(ray.origin), back.turn(ray.direction)} : ray;
    SurfaceHit hit;
    if (is_copy) {
        const Ray there{place.apply_inverse(own.origin), place.turn_back(own.direction) / place.scale};
        hit = target->first_hit(there, span);
        hit.normal = place.turn(hit.normal);
    } else {
        hit = target->first_hit(own, span);
    }
    if (is_moved) hit.normal = normalized(back.pull(hit.normal));
    if (is_cavity) hit.normal = -hit.normal;
    if (hit.found()) hit.object = object;
    return hit;
}

Extreme RayPiece::nearest(const Vec3& p, double within, double accuracy, ExtremeSearch& search) const {
    const Similarity& s = *whole;
    Extreme found =
        target->extreme({s.apply_inverse(p), false}, within / s.scale, accuracy / s.scale, search);
    return {s.apply(found.point), found.cost * s.scale, found.proved * s.scale};
}

// direction · (M p + t) is (Mᵀ direction) · p + direction · t. The search's cost is the negative.
std::optional<double> RayPiece::most_along(const Vec3& direction, double accuracy,
                                           ExtremeSearch& search) const {
    const Vec3 own = is_moved ? moved.pull(direction) : direction;
    const double length = norm(own), scale = length * (is_copy ? place.scale : 1);
    const Vec3 unit = own / length;
    const Extreme found = target->extreme({is_copy ? place.turn_back(unit) : unit, true},
                                          std::numeric_limits<double>::infinity(), accuracy / scale, search);
    if (!found.found()) return {};
    return -found.proved * scale + (is_copy ? dot(own, place.translation) : 0) +
           (is_moved ? dot(direction, moved.translation) : 0);
}

Vec3 RayPiece::to_target(const Vec3& world) const {
    const Vec3 own = is_moved ? back.apply(world) : world;
    return is_copy ? place.apply_inverse(own) : own;
}

Box RayPiece::in_world(const Box& box) const {
    const Box own = is_copy ? box_of_image(box, place) : box;
    return is_moved ? box_of_image(own, moved) : own;
}

std::vector<Box> RayPiece::cover() const {
    std::vector<Box> all;
    for (const Box& box : target->cover()) all.push_back(in_world(box));
    return all;
}

}  // namespace pfgeom
