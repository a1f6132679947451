#include "pfgeom/mesh/split_faces.h"

#include <array>
#include <cstddef>
#include <span>

namespace pfgeom {
namespace {

using Chains = std::array<std::span<const std::int32_t>, 3>;  // of a face's three sides

/// A fan from the corner opposite of the first side that has vertices; the other two sides belong to the
/// first and the last face of the fan.
void split(const Triangle& face, const Chains& chains, std::vector<Triangle>& out) {
    std::size_t side = 0;
    while (side < 3 && chains[side].empty()) ++side;
    if (side == 3) {
        out.push_back(face);
        return;
    }
    const std::int32_t apex = face[(side + 2) % 3], end = face[(side + 1) % 3];
    const auto inner = chains[side];
    std::int32_t from = face[side];
    for (std::size_t i = 0; i <= inner.size(); ++i) {
        const std::int32_t to = i < inner.size() ? inner[i] : end;
        Chains rest;
        if (i == inner.size()) rest[1] = chains[(side + 1) % 3];
        if (i == 0) rest[2] = chains[(side + 2) % 3];
        split({from, to, apex}, rest, out);
        from = to;
    }
}

}  // namespace

std::vector<Triangle> split_faces(const std::vector<Triangle>& faces, const std::vector<SideChain>& chains) {
    std::vector<Triangle> out;
    out.reserve(faces.size() + 2 * chains.size());
    auto chain = chains.begin();
    for (std::size_t face = 0; face < faces.size(); ++face) {
        Chains of_face;
        for (; chain != chains.end() && static_cast<std::size_t>(chain->side) / 3 == face; ++chain)
            of_face[static_cast<std::size_t>(chain->side) % 3] = chain->inner;
        split(faces[face], of_face, out);
    }
    return out;
}

}  // namespace pfgeom
