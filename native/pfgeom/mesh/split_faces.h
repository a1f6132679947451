// Faces cut where vertices lie on their sides.
#pragma once

#include "pfgeom/base/triangle.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// A side of a face (3 * face + corner) and the vertices on it, in the side's direction.
struct SideChain {
    std::int32_t side;
    std::vector<std::int32_t> inner;
};

/// `chains` by rising side. The pieces of a face stand where the face stood.
std::vector<Triangle> split_faces(const std::vector<Triangle>& faces, const std::vector<SideChain>& chains);

}  // namespace pfgeom
