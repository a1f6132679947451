#include "pfgeom/mesh/check.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/mesh/prepare.h"

#include <cmath>
#include <string>

namespace pfgeom {

void check_indices(const TriangleMesh& mesh) {
    const auto n = static_cast<std::int64_t>(mesh.vertices.size());
    for (std::size_t row = 0; row < mesh.faces.size(); ++row)
        for (const std::int32_t v : mesh.faces[row])
            if (v < 0 || v >= n)
                throw InvalidInput("face " + std::to_string(row) + " has vertex index " + std::to_string(v) +
                                   ", there are " + std::to_string(n) + " vertices (rows from 0)");
}

void check_finite(const TriangleMesh& mesh) {
    constexpr double kLargest = 1e100;  // volumes, cubes of differences, stay finite
    for (std::size_t row = 0; row < mesh.vertices.size(); ++row) {
        const Vec3& v = mesh.vertices[row];
        if (!is_finite(v))
            throw InvalidInput("vertex " + std::to_string(row) + " has a coordinate that is not finite");
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(v[axis]) > kLargest)
                throw InvalidInput("vertex " + std::to_string(row) + " has a coordinate beyond 1e100");
    }
}

void check_mesh(const TriangleMesh& input) {
    if (input.vertices.size() > Limits{}.vertices)
        throw InvalidInput("the mesh has more vertices than the limit");
    if (input.faces.size() > Limits{}.faces) throw InvalidInput("the mesh has more faces than the limit");
    check_finite(input);
    check_indices(input);
    if (!(surface_area(input) > 0)) throw InvalidInput("the mesh has no faces with area");
}

}  // namespace pfgeom
