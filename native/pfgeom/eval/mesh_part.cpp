#include "pfgeom/eval/mesh_part.h"

#include "pfgeom/eval/mirror_image.h"

namespace pfgeom {
namespace {

// Curved faces are divided until they are this share of the default mesh's chord tolerance from the surface.
constexpr double kChordShare = 0.25;

}  // namespace

TriangleMesh mesh_of(const Object& object, const Fineness& fineness, const Task& task) {
    const auto& part = std::get<MeshPart>(object.shape);
    if (part.curved()) return divide_patches(object, fineness, task);
    TriangleMesh mesh;
    mesh.faces = part.faces;
    mesh.vertices.reserve(part.positions.size());
    for (const auto& p : part.positions) mesh.vertices.push_back(object.frame.to_world(part.local(p)));
    if (part.mirror) add_mirror_image(object.frame, *part.mirror, mesh);
    return mesh;
}

TriangleMesh mesh_for_values(const Object& object, double diagonal) {
    return mesh_of(object, {.chord = kChordShare * chord_of(object, diagonal)});
}

}  // namespace pfgeom
