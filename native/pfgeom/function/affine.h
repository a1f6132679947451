// Invertible affine maps of the world: rigid ones, mirrored, scaled, sheared.
#pragma once

#include "pfgeom/base/vec.h"
#include "pfgeom/function/frame.h"
#include "pfgeom/function/placement.h"
#include "pfgeom/function/quadric.h"

#include <array>
#include <optional>
#include <string>

namespace pfgeom {

struct Affine {
    std::array<Vec3, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Vec3 translation;

    Vec3 apply(const Vec3& p) const { return turn(p) + translation; }
    /// Of differences of points.
    Vec3 turn(const Vec3& d) const { return {dot(rows[0], d), dot(rows[1], d), dot(rows[2], d)}; }
    /// By the transposed matrix: the gradient of f(apply(p)) from that of f.
    Vec3 pull(const Vec3& g) const { return g.x * rows[0] + g.y * rows[1] + g.z * rows[2]; }
    bool mirrors() const { return dot(rows[0], cross(rows[1], rows[2])) < 0; }

    friend bool operator==(const Affine&, const Affine&) = default;
};

Affine affine_of(const Similarity& similarity);
/// From the frame's cube to the world.
Affine affine_of(const Frame& frame);

/// The same map, if it keeps angles but for rounding.
std::optional<Similarity> similarity_of(const Affine& map);

/// First `inner`, then `outer`.
Affine composed(const Affine& outer, const Affine& inner);
/// By cofactors: of a rotation as exact as the rotation is orthogonal, of an integer one exact.
Affine inverse_of(const Affine& map);

/// The most that a length grows by: of a similarity its scale, else up to a factor of √3 more. (The largest
/// sum of a row of |MᵀM|.)
double most_stretch(const Affine& map);

/// What is wrong, as a sentence; empty if nothing is. Numbers are bounded, and what is flattened to less than
/// a millionth counts as flat.
std::string find_flaw(const Affine& map);

/// The quadric q(map(p)) of p.
Quadric substituted(const Quadric& q, const Affine& map);

}  // namespace pfgeom
