// A closed 2-manifold triangle mesh that can be changed: triangles with their neighbours.
#pragma once

#include "pfgeom/base/triangle.h"
#include "pfgeom/base/vec.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace pfgeom {

/// Half-edge 3t+i runs from corner i of triangle t to corner i+1 of it.
class SurfaceMesh {
  public:
    std::vector<Vec3> position, normal;  ///< of the vertices; unit normals point outside

    /// `faces`: a closed 2-manifold whose vertices are joined by at most one edge.
    void set_faces(std::vector<Triangle> faces) {
        faces_ = std::move(faces);
        find_neighbours();
    }
    void find_neighbours();
    /// With the neighbours: vertices may be joined by several edges until these are split.
    void set_faces(std::vector<Triangle> faces, std::vector<std::int32_t> twins) {
        faces_ = std::move(faces);
        twins_ = std::move(twins);
    }

    std::size_t face_count() const { return faces_.size(); }
    const std::vector<Triangle>& faces() const { return faces_; }
    std::vector<Triangle> take_faces() { return std::move(faces_); }
    std::int32_t half_edges() const { return static_cast<std::int32_t>(3 * faces_.size()); }

    static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static std::int32_t previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
    std::int32_t from(std::int32_t h) const { return faces_[h / 3][h % 3]; }
    std::int32_t to(std::int32_t h) const { return from(next(h)); }
    std::int32_t apex(std::int32_t h) const { return from(previous(h)); }
    std::int32_t twin(std::int32_t h) const { return twins_[h]; }
    bool alive(std::int32_t face) const { return faces_[face][0] >= 0; }

    /// visit(half-edge) for each from from(h), h first.
    template <class Visit>
    void for_each_spoke(std::int32_t h, Visit visit) const {
        std::int32_t spoke = h;
        do {
            visit(spoke);
            spoke = twin(previous(spoke));
        } while (spoke != h);
    }
    /// Are the two ends of the half-edges' start vertices joined? Walks around from(h).
    bool joined(std::int32_t h, std::int32_t vertex) const;
    int valence(std::int32_t h) const;  ///< of from(h)

    /// Cuts the edge at `vertex`, which has no faces yet: two triangles become four. h then ends at `vertex`.
    void split(std::int32_t h, std::int32_t vertex);
    /// Turns the edge within its two triangles. The apexes must not be joined already.
    void flip(std::int32_t h);
    /// Merges from(h) into to(h); false, and nothing done, where the result would be no manifold.
    bool collapse(std::int32_t h);
    /// Drops dead faces and unused vertices.
    void compact();

  private:
    void set_face(std::int32_t face, std::int32_t a, std::int32_t b, std::int32_t c) {
        faces_[face] = {a, b, c};
    }
    void glue(std::int32_t g, std::int32_t h) {
        twins_[g] = h;
        twins_[h] = g;
    }

    std::vector<Triangle> faces_;      // -1 in dead ones
    std::vector<std::int32_t> twins_;  // by half-edge
};

}  // namespace pfgeom
