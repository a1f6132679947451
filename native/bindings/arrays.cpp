#include "arrays.h"

#include "pfgeom/base/error.h"
#include "pfgeom/mesh/prepare.h"

#include <cstring>
#include <string>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

template <class Row, class Array>
std::vector<Row> copy_rows(const Array& array, const char* what) {
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw InvalidInput(std::string(what) + " must have shape (n, 3)");
    std::vector<Row> rows(static_cast<std::size_t>(array.shape(0)));
    if (!rows.empty()) std::memcpy(static_cast<void*>(rows.data()), array.data(), rows.size() * sizeof(Row));
    return rows;
}

}  // namespace

std::vector<Vec3> points_from(const Points& points) {
    return copy_rows<Vec3>(points, "points");
}

TriangleMesh mesh_from(const Points& vertices, const Indices& faces) {
    TriangleMesh mesh{copy_rows<Vec3>(vertices, "vertices"), copy_rows<Triangle>(faces, "faces")};
    check_mesh(mesh);
    return mesh;
}

FaceMaterials materials_from(const std::optional<Indices>& of_face, std::vector<std::string> names,
                             std::size_t faces) {
    FaceMaterials materials;
    if (of_face) {
        const std::span<const std::int32_t> rows = span_of(*of_face);
        materials.of_face.assign(rows.begin(), rows.end());
    }
    materials.names = std::move(names);
    check_materials(materials, faces);
    return materials;
}

py::tuple arrays_from(PaintedMesh painted) {
    std::vector<std::int32_t>& of_face = painted.materials.of_face;
    const auto count = static_cast<py::ssize_t>(of_face.size());
    py::object materials = py::none();
    if (count > 0) materials = array_of<std::int32_t>(std::move(of_face), {count});
    return py::make_tuple(array_from<double>(std::move(painted.mesh.vertices)),
                          array_from<std::int32_t>(std::move(painted.mesh.faces)), materials,
                          painted.materials.names);
}

}  // namespace pfgeom::bindings
