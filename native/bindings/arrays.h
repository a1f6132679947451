// numpy arrays <-> the library's vectors.
#pragma once

#include "pfgeom/mesh/face_materials.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pfgeom::bindings {

/// What the package passes: exactly this type, C-contiguous; anything else is a TypeError (bind with
/// noconvert).
using Points = pybind11::array_t<double, pybind11::array::c_style>;
using Indices = pybind11::array_t<std::int32_t, pybind11::array::c_style>;

/// Copies (n,3) and (m,3). Throws InvalidInput: shapes, coordinates that are not finite, indices out of
/// range.
TriangleMesh mesh_from(const Points& vertices, const Indices& faces);

/// Rows of a (n,3) array of points, as they lie in memory.
std::vector<Vec3> points_from(const Points& points);

/// All entries, in the order of memory; valid as long as the array.
inline std::span<const std::int32_t> span_of(const Indices& indices) {
    return {indices.data(), static_cast<std::size_t>(indices.size())};
}

/// Hands the rows over without a copy: the array owns them. `shape` must hold all their scalars.
template <class Scalar, class Row>
pybind11::array_t<Scalar> array_of(std::vector<Row> rows, std::vector<pybind11::ssize_t> shape) {
    static_assert(sizeof(Row) % sizeof(Scalar) == 0);
    auto owned = std::make_unique<std::vector<Row>>(std::move(rows));
    const auto* data = reinterpret_cast<const Scalar*>(owned->data());
    const pybind11::capsule owner(owned.get(), [](void* p) { delete static_cast<std::vector<Row>*>(p); });
    owned.release();
    return pybind11::array_t<Scalar>(std::move(shape), data, owner);
}

/// Rows of three, as (n, 3).
template <class Scalar, class Row>
pybind11::array_t<Scalar> array_from(std::vector<Row> rows) {
    static_assert(sizeof(Row) == 3 * sizeof(Scalar));
    const auto count = static_cast<pybind11::ssize_t>(rows.size());
    return array_of<Scalar>(std::move(rows), {count, 3});
}

/// Materials of (m,) faces, or None: all alike. Throws InvalidInput as check_materials does.
FaceMaterials materials_from(const std::optional<Indices>& of_face, std::vector<std::string> names,
                             std::size_t faces);

/// (vertices (n,3) float64, faces (m,3) int32, materials (m,) int32 or None, names)
pybind11::tuple arrays_from(PaintedMesh mesh);

}  // namespace pfgeom::bindings
