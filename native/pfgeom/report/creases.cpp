#include "pfgeom/report/creases.h"

#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/weld.h"

#include <span>

namespace pfgeom {
namespace {

constexpr double kCosine = 0.86602540378443864676;  // of 30 degrees, as Model.corner_normals has it

class CreaseFinder {
  public:
    explicit CreaseFinder(const TriangleMesh& mesh) : welded_{mesh.vertices, mesh.faces} {
        reindex(welded_.faces, exact_representatives(mesh));
        remove_repeated_corners(welded_.faces);
        remove_duplicates(welded_.faces);
    }

    TriangleMesh find(const Task& task) const {
        TriangleMesh creases{welded_.vertices, {}};
        const EdgeTable edges(welded_.faces, welded_.vertices.size());
        edges.for_each([&](std::span<const EdgeUse> uses) {
            if (uses.front().lo % kEdgesBetweenChecks == 0) task.check();
            if (uses.size() > 2 || (uses.size() == 2 && turns(uses[0], uses[1])))
                creases.faces.push_back({uses.front().lo, uses.front().hi, uses.front().hi});
        });
        return creases;
    }

  private:
    static constexpr std::int32_t kEdgesBetweenChecks = 4096;

    Vec3 normal(std::int32_t face) const {
        const auto& [a, b, c] = welded_.faces[static_cast<std::size_t>(face)];
        const Vec3 p = welded_.vertices[static_cast<std::size_t>(a)];
        return normalized(cross(welded_.vertices[static_cast<std::size_t>(b)] - p,
                                welded_.vertices[static_cast<std::size_t>(c)] - p));
    }

    bool turns(const EdgeUse& one, const EdgeUse& other) const {
        const Vec3 a = normal(one.face()), b = normal(other.face());
        if (a == Vec3{} || b == Vec3{}) return false;  // a face without area has no side
        const double cosine = dot(a, b);
        return (one.forward == other.forward ? -cosine : cosine) < kCosine;
    }

    TriangleMesh welded_;
};

}  // namespace

Creases::Creases(const TriangleMesh& mesh, const Task& task) : edges_(CreaseFinder(mesh).find(task), task) {}

}  // namespace pfgeom
