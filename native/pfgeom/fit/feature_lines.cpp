#include "pfgeom/fit/feature_lines.h"

#include "pfgeom/mesh/edges.h"

#include <optional>

namespace pfgeom {
namespace {

// Edges of the original whose faces meet at more than 37 degrees are creases; edges of a patch follow them
// where its faces meet at more than 20 degrees.
constexpr double kCreaseCosine = 0.8, kFollowingCosine = 0.94;

Vec3 normal_of(const TriangleMesh& mesh, std::int32_t face) {
    const Triangle& t = mesh.faces[static_cast<std::size_t>(face)];
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    return normalized(cross(at(1) - at(0), at(2) - at(0)));
}

bool is_crease(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
    return uses.size() == 2 &&
           dot(normal_of(mesh, uses[0].face()), normal_of(mesh, uses[1].face())) < kCreaseCosine;
}

template <class Chosen>
TriangleMesh edges_of(const TriangleMesh& mesh, Chosen chosen) {
    TriangleMesh lines{mesh.vertices, {}};
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        if (chosen(uses)) lines.faces.push_back({uses[0].lo, uses[0].hi, uses[0].hi});
    });
    return lines;
}

}  // namespace

FeatureLines::FeatureLines(const TriangleMesh& original, const Task& task)
    : borders_(edges_of(original, [](std::span<const EdgeUse> uses) { return uses.size() != 2; }), task),
      creases_(edges_of(original, [&](std::span<const EdgeUse> uses) { return is_crease(original, uses); }),
               task) {}

Spokes FeatureLines::spokes_of(const Patch& patch, double near) const {
    Spokes spokes(patch);
    const Vec3 middle = patch.triangles[0][0];
    const auto on_crease = [&](const Vec3& p) { return creases_.closest(p, near).face >= 0; };
    std::optional<bool> middle_is;
    for (Spoke& s : spokes.list()) {
        if (s.faces != 2 || (s.seam && s.fold < kFollowingCosine)) {
            s.line = &borders_;  // of a half its cut is one
        } else if (s.fold < kFollowingCosine) {
            if (!middle_is) middle_is = on_crease(middle);
            if (!*middle_is || !on_crease(middle + s.along)) continue;
            s.line = &creases_;
            s.bent = true;
        }
    }
    return spokes;
}

}  // namespace pfgeom
