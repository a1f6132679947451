// From any input to a mesh that the later stages can rely on: checked, welded, with its defects counted.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// What was found. Nothing is refused for its shape; every count is of the input.
struct MeshDefects {
    std::int64_t unused_vertices = 0;
    std::int64_t duplicate_vertices = 0;  ///< exact copies, welded
    std::int64_t degenerate_faces = 0;    ///< two equal corners or no area; kept out of the surface
    std::int64_t duplicate_faces = 0;     ///< the same three points again, in any order
    std::int64_t boundary_edges = 0;      ///< used by one face, after welding and seams
    std::int64_t seam_edges = 0;          ///< boundary edges that coincided within the seam distance, joined
    std::int64_t non_manifold_edges = 0;  ///< used by three or more faces
    std::int64_t non_manifold_vertices = 0;
    std::int64_t misoriented_edges = 0;  ///< traversed in the same direction by both faces
};

/// A part of the surface that hangs together by edges (seams count as connected).
struct Island {
    std::vector<std::int32_t> faces;  ///< rows of PreparedMesh::mesh.faces, rising
    bool closed = false;              ///< every edge has an even number of faces, which is two if `manifold`
    bool manifold = false;            ///< every edge has at most two faces, every vertex one fan
    bool oriented = false;            ///< the directions of every edge balance
    double area = 0;
    double signed_volume = 0;  ///< > 0: normals point outwards; meaningful if closed
    std::int32_t parent = -1;  ///< the next closed, oriented island around this one (such too), or -1
};

struct PreparedMesh {
    TriangleMesh mesh;            ///< welded, seams joined; degenerate, duplicate and unused ones removed
    std::vector<Island> islands;  ///< by their lowest face
    MeshDefects defects;
    double diagonal = 0;
};

/// Throws InvalidInput on NaN or infinite coordinates, indices out of range (each with its row), or no faces
/// with area. `seam_distance`: boundary edges closer than this (in the mesh's units) coincide; they are
/// joined: faces get other vertices, at most so far away, and are split at T-junctions.
PreparedMesh prepare_mesh(const TriangleMesh& input, double seam_distance, const Task& task = {});

/// Only the checks of prepare_mesh on values: finite, indices in range, not empty.
void check_mesh(const TriangleMesh& input);

/// The faces of one island with their own vertices.
TriangleMesh extract_island(const PreparedMesh& prepared, const Island& island);

}  // namespace pfgeom
