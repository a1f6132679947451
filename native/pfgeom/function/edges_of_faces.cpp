#include "pfgeom/function/edges_of_faces.h"

#include <algorithm>
#include <cstddef>

namespace pfgeom {

EdgesOfFaces EdgesOfFaces::of(const std::vector<Triangle>& faces) {
    struct Side {
        std::int32_t low, high;
        std::size_t place;  // 3 · face + k
        bool operator<(const Side& o) const {
            return low != o.low ? low < o.low : high != o.high ? high < o.high : place < o.place;
        }
    };
    std::vector<Side> sides;
    sides.reserve(3 * faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = faces[f][k], b = faces[f][(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), 3 * f + k});
        }
    }
    std::sort(sides.begin(), sides.end());
    std::vector<std::size_t> first(sides.size());  // of each place: the first place of its edge
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
        for (; j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high; ++j)
            first[sides[j].place] = sides[i].place;
    }
    EdgesOfFaces edges;
    edges.of_face.resize(faces.size());
    for (std::size_t place = 0; place < first.size(); ++place) {
        const std::size_t f = place / 3, k = place % 3, before = first[place];
        if (before == place) {
            edges.of_face[f][k] = static_cast<std::int32_t>(edges.ends.size());
            edges.ends.push_back({faces[f][k], faces[f][(k + 1) % 3]});
        } else {
            edges.of_face[f][k] = edges.of_face[before / 3][before % 3];
        }
    }
    return edges;
}

}  // namespace pfgeom
