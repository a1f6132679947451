#include "arrays.h"
#include "bindings.h"
#include "job.h"
#include "pfgeom/base/error.h"
#include "pfgeom/base/file.h"
#include "pfgeom/mesh/file.h"
#include "pfgeom/mesh/triangulate.h"

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

py::tuple read_arrays(const std::string& path) {
    LoadedMesh loaded = Job().run([=](const Task&) { return read_mesh_file(path); });
    const py::tuple lost = py::tuple(py::cast(loaded.lost));
    return arrays_from({std::move(loaded.mesh), std::move(loaded.materials)}) + py::make_tuple(lost);
}

void write_bytes(const std::string& path, const py::bytes& data) {
    const std::string_view view = data;
    const py::gil_scoped_release unlocked;
    write_file(path, {reinterpret_cast<const std::uint8_t*>(view.data()), view.size()});
}

py::bytes read_bytes(const std::string& path) {
    std::vector<std::uint8_t> bytes;
    {
        const py::gil_scoped_release unlocked;
        bytes = read_file(path);
    }
    return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// Corner tests that a call may spend on concave polygons, about two seconds; the rest become fans.
constexpr std::int64_t kTests = 1'000'000'000;

std::vector<Triangle> triangulate(const std::vector<Vec3>& vertices, std::span<const std::int32_t> corners,
                                  std::span<const std::int32_t> lengths) {
    for (const std::int32_t corner : corners)
        if (corner < 0 || static_cast<std::size_t>(corner) >= vertices.size())
            throw InvalidInput("corner out of range");
    std::int64_t budget = kTests;
    std::vector<Triangle> faces;
    faces.reserve(corners.size());
    for (const std::int32_t length : lengths) {
        if (length < 3 || static_cast<std::size_t>(length) > corners.size())
            throw InvalidInput("lengths do not fit the corners");
        const auto cut =
            triangulate_polygon(vertices, corners.first(static_cast<std::size_t>(length)), budget);
        faces.insert(faces.end(), cut.begin(), cut.end());
        corners = corners.subspan(static_cast<std::size_t>(length));
    }
    return faces;
}

py::array triangulate_arrays(const Points& vertices, const Indices& corners, const Indices& lengths) {
    const std::vector<Vec3> points = points_from(vertices);
    std::vector<Triangle> faces;
    {
        const py::gil_scoped_release unlocked;
        faces = triangulate(points, span_of(corners), span_of(lengths));
    }
    return array_from<std::int32_t>(std::move(faces));
}

}  // namespace

void bind_mesh(py::module_& m) {
    m.def("read_mesh", &read_arrays, py::arg("path"));
    m.def(
        "write_mesh",
        [](const std::string& path, const Points& vertices, const Indices& faces,
           const std::optional<Indices>& materials, std::vector<std::string> names) {
            const TriangleMesh mesh = mesh_from(vertices, faces);
            const FaceMaterials painted = materials_from(materials, std::move(names), mesh.faces.size());
            const py::gil_scoped_release unlocked;
            write_mesh(path, mesh, painted);
        },
        py::arg("path"), py::arg("vertices").noconvert(), py::arg("faces").noconvert(),
        py::arg("materials").noconvert(), py::arg("names"));
    m.def("triangulate", &triangulate_arrays, py::arg("vertices").noconvert(), py::arg("corners").noconvert(),
          py::arg("lengths").noconvert());
    m.def("read_file", &read_bytes, py::arg("path"), "Whole file, bounded.");
    m.def("write_file", &write_bytes, py::arg("path"), py::arg("data"), "Whole or absent.");
}

}  // namespace pfgeom::bindings
