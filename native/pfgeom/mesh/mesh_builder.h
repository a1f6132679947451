// Collects a file's vertices and polygons. A polygon may come before its vertices (OBJ), so polygons are kept
// as fans and become proper triangulations once all vertices are known.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pfgeom {

/// Where in a file: "line 12", "face 7".
struct Place {
    const char* unit;
    std::int64_t number;
};

class MeshBuilder {
  public:
    void reserve_vertices(std::size_t n) { mesh_.vertices.reserve(n); }
    std::size_t face_count() const { return mesh_.faces.size(); }  ///< so far, triangles
    std::int64_t vertex_count() const { return static_cast<std::int64_t>(mesh_.vertices.size()); }

    void add_vertex(const Vec3& position) { mesh_.vertices.push_back(position); }
    /// Corners are rows from 0. One or two corners make a degenerate triangle, to be counted as such.
    /// Throws InvalidInput at once on a negative corner, in finish() on one past the last vertex.
    void add_polygon(std::span<const std::int64_t> corners, const Place& place);

    TriangleMesh finish();

  private:
    struct Fan {
        std::size_t first;    // row of faces
        std::size_t corners;  // corners - 2 faces
    };
    void triangulate(const Fan& fan, std::int64_t& budget);

    TriangleMesh mesh_;
    std::vector<Fan> fans_;
    std::int64_t highest_ = -1;  // corner, and where it first occurred
    Place highest_place_{"face", 0};
};

}  // namespace pfgeom
