#include "pfgeom/render/ray_piece.h"

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
