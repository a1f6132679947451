#include "pfgeom/algebra/closed.h"

#include "pfgeom/base/error.h"
#include "pfgeom/function/edges_of_faces.h"

#include <string>

namespace pfgeom {
namespace {

// As many faces along each edge as against it: the winding number is then an integer everywhere. Where the
// halves of a mirrored part are joined their images make up for them.
bool is_closed(const MeshPart& part) {
    const EdgesOfFaces edges = EdgesOfFaces::of(part.faces);
    std::vector<std::int32_t> along(edges.ends.size());
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto edge = static_cast<std::size_t>(edges.of_face[f][i]);
            along[edge] += edges.ends[edge][0] == part.faces[f][i] ? 1 : -1;
        }
    }
    for (std::size_t i = 0; i < along.size(); ++i) {
        if (along[i] != 0 && !part.is_seam(edges.ends[i])) return false;
    }
    return true;
}

}  // namespace

void require_closed(const Model& model) {
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
        const auto& shape = model.objects[i].shape;
        const auto* part = std::get_if<MeshPart>(&shape);
        if (!std::holds_alternative<Sheet>(shape) && (!part || is_closed(*part))) continue;
        throw InvalidInput(
            "object " + std::to_string(i) +
            " is an open surface, which has no inside: set operations and offsets take closed objects");
    }
}

}  // namespace pfgeom
