// An object where it lies in a scene: in place or as a copy, and where its operand's transforms put it.
#pragma once

#include "pfgeom/function/affine.h"
#include "pfgeom/render/ray_target.h"

#include <optional>

namespace pfgeom {

struct RayPiece {
    const RayTarget* target = nullptr;
    std::int32_t object = -1;
    bool is_copy = false, is_cavity = false, is_moved = false;
    Similarity place{};
    Affine moved{}, back{};             ///< of the operand, and its inverse
    std::optional<Similarity> whole{};  ///< copy and operand together, if that keeps ratios of distances

    SurfaceHit first_hit(const Ray& ray, const RaySpan& span) const;
    /// Is the point inside the object? Of mesh parts only, whose faces need not say.
    bool contains(const Vec3& world) const { return target->contains(to_target(world)); }
    /// The point of its surface nearest to p, if it is nearer than `within`; of a piece that `whole` places.
    Extreme nearest(const Vec3& p, double within, double accuracy, ExtremeSearch& search) const;
    /// The most of direction · p over its surface, and at most `accuracy` more; nothing if it has none.
    std::optional<double> most_along(const Vec3& direction, double accuracy, ExtremeSearch& search) const;
    /// The target's cover.
    std::vector<Box> cover() const;
    Box in_world(const Box& box) const;

  private:
    Vec3 to_target(const Vec3& world) const;
};

}  // namespace pfgeom
