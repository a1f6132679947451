// From any input to a mesh that the later stages can rely on: checked, welded, with its defects counted.
#pragma once

#include <cstdint>
#include <vector>

#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// What was found. Nothing is refused for its shape; every count is of the input.
struct MeshDefects {
    std::int64_t unused_vertices = 0;
    std::int64_t duplicate_vertices = 0;   ///< exact copies, welded
    std::int64_t degenerate_faces = 0;     ///< two equal corners or no area; kept out of the surface
    std::int64_t duplicate_faces = 0;      ///< the same three points again, in any order
    std::int64_t boundary_edges = 0;       ///< used by one face, after welding and seams
    std::int64_t seam_edges = 0;           ///< boundary edges that coincide with others within the seam distance
    std::int64_t non_manifold_edges = 0;   ///< used by three or more faces
    std::int64_t non_manifold_vertices = 0;
    std::int64_t misoriented_edges = 0;    ///< traversed in the same direction by both faces
};

/// A part of the surface that hangs together by edges (seams count as connected).
struct Island {
    std::vector<std::int32_t> faces;  ///< rows of PreparedMesh::mesh.faces, rising
    bool closed = false;              ///< every edge has two faces (or is a seam)
    bool manifold = false;            ///< every edge has at most two faces, every vertex one fan
    bool oriented = false;            ///< no misoriented edge
    double area = 0;
    double signed_volume = 0;         ///< > 0: normals point outwards; meaningful if closed
    std::int32_t parent = -1;         ///< the closed island that this closed island lies inside of, or -1
};

struct PreparedMesh {
    TriangleMesh mesh;                 ///< welded; degenerate and duplicate faces and unused vertices removed
    std::vector<Island> islands;       ///< by their lowest face
    MeshDefects defects;
    double diagonal = 0;
};

/// Throws InvalidInput on NaN or infinite coordinates, indices out of range (each with its row), or no faces
/// with area. `seam_distance`: boundary edges closer than this (in the mesh's units) coincide.
PreparedMesh prepare_mesh(const TriangleMesh& input, double seam_distance);

/// Only the checks of prepare_mesh on values: finite, indices in range, not empty.
void check_mesh(const TriangleMesh& input);

/// The faces of one island with their own vertices.
TriangleMesh extract_island(const PreparedMesh& prepared, const Island& island);

}  // namespace pfgeom
