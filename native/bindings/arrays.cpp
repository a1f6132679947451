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

py::tuple arrays_from(TriangleMesh mesh) {
    return py::make_tuple(array_from<double>(std::move(mesh.vertices)),
                          array_from<std::int32_t>(std::move(mesh.faces)));
}

}  // namespace pfgeom::bindings
