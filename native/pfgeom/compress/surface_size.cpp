#include "pfgeom/compress/surface_size.h"

#include "pfgeom/base/error.h"
#include "pfgeom/compress/object_mesh.h"
#include "pfgeom/mesh/edges.h"

#include <cmath>

namespace pfgeom {
namespace {

// Each edge is used as often one way as the other.
bool is_closed(const TriangleMesh& mesh) {
    bool closed = true;
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        std::ptrdiff_t balance = 0;
        for (const EdgeUse& use : uses) balance += use.lo == use.hi ? 0 : use.forward ? 1 : -1;
        closed = closed && balance == 0;
    });
    return closed;
}

// By the divergence theorem, about a point near the surface, where numbers are small.
double enclosed_volume(const TriangleMesh& mesh) {
    if (mesh.faces.empty() || !is_closed(mesh)) return 0;
    const Vec3 origin = bounds(mesh).centre();
    double sum = 0;
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3 a = mesh.vertices[i] - origin, b = mesh.vertices[j] - origin,
                   c = mesh.vertices[k] - origin;
        sum += dot(a, cross(b, c));
    }
    return std::abs(sum) / 6;
}

}  // namespace

SurfaceSize surface_size(const Model& model, double tolerance, const Task& task) {
    if (!(tolerance > 0 && std::isfinite(tolerance)))
        throw InvalidInput("the tolerance must be a positive number");
    SurfaceSize size;
    if (!model.combination.empty()) {
        const TriangleMesh mesh = to_mesh(model, {tolerance, {}}, task);
        return {surface_area(mesh), enclosed_volume(mesh)};
    }
    const ObjectsToMesh all{model.objects, model.diagonal, {tolerance, {}}};
    const auto count = static_cast<double>(model.objects.size());
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
        const Object& object = model.objects[i];
        const auto at = static_cast<double>(i);
        const Task part = part_of(task, at / count, (at + 1) / count);
        part.report(0, "measure");
        const TriangleMesh mesh = mesh_in_place(model, all, object, part);
        const double area = surface_area(mesh), volume = enclosed_volume(mesh);
        for (const Similarity& s : copies_of(object)) {
            const double square = s.scale * s.scale;
            size.area += square * area;
            size.volume += (object.cavity_of >= 0 ? -1 : 1) * square * s.scale * volume;
        }
    }
    task.report(1, "measure");
    return size;
}

}  // namespace pfgeom
