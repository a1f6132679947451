// Seeded, stratified samples of a surface: one in each of n equal slices of its cumulated area.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pfgeom {

struct SurfaceSamples {
    std::vector<Vec3> points;         ///< #S by 3
    std::vector<std::int32_t> faces;  ///< #S rows of the mesh's faces
    std::vector<Vec3> barycentric;    ///< #S by 3, weights of the face's corners
};

SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

/// Area-weighted unit normals, #V by 3 (zero where a vertex has no face with area).
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);

}  // namespace pfgeom
