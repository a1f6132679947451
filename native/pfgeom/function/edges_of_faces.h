// The edges of a list of faces, any number of faces an edge.
#pragma once

#include "pfgeom/base/triangle.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

struct EdgesOfFaces {
    std::vector<std::array<std::int32_t, 2>> ends;  ///< each edge once, as the first face with it has it
    std::vector<Triangle> of_face;                  ///< rows of `ends`: of the edges 0-1, 1-2, 2-0

    /// Edges stand in the order in which the faces, and in these the edges, first name them.
    static EdgesOfFaces of(const std::vector<Triangle>& faces);
};

}  // namespace pfgeom
