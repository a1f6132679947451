// The box around a box that was moved.
#pragma once

#include "pfgeom/base/box.h"

namespace pfgeom {

/// Bits 0, 1, 2 of `corner` (0 .. 7): the high end in x, y, z.
inline Vec3 corner_of(const Box& box, unsigned corner) {
    return {(corner & 1U) != 0 ? box.hi.x : box.lo.x, (corner & 2U) != 0 ? box.hi.y : box.lo.y,
            (corner & 4U) != 0 ? box.hi.z : box.lo.z};
}

/// Of all corners, moved by a Similarity or an Affine.
template <class Map>
Box box_of_image(const Box& box, const Map& map) {
    Box all;
    for (unsigned corner = 0; corner < 8; ++corner) all.grow(map.apply(corner_of(box, corner)));
    return all;
}

}  // namespace pfgeom
