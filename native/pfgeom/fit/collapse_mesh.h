// A triangle soup that edge collapses thin out: corners of faces, and the faces at each vertex. No
// half-edges, so that edges with any number of faces and vertices with any number of fans are nothing
// special. Its faces are flat, or curved with a bulge on each edge. Of the half above a mirror's plane the
// vertices on the plane stay on it, and all others above.
#pragma once

#include "pfgeom/function/curved_triangle.h"
#include "pfgeom/mesh/halves.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace pfgeom {

/// Square of a triangle's longest side.
inline double longest_squared(const std::array<Vec3, 3>& t) {
    return std::max({squared_norm(t[1] - t[0]), squared_norm(t[2] - t[1]), squared_norm(t[0] - t[2])});
}

/// What an operation would do: the faces around one vertex at its new place, instead of the faces before.
struct Patch {
    std::vector<std::int32_t> before;               ///< faces whose surface is replaced
    std::vector<std::int32_t> after;                ///< those of them that stay
    std::vector<std::array<Vec3, 3>> triangles;     ///< of each of `after`; corner 0 is the moving vertex
    std::vector<std::array<Vec3, 3>> bulges;        ///< of their edges 0-1, 1-2, 2-0; empty: they are flat
    std::vector<std::array<std::int32_t, 2>> ends;  ///< curved: their corners 1 and 2
    int fixed_axis = kNoAxis;                       ///< the moving vertex keeps this coordinate
    static constexpr int kNoAxis = -1;
    void move_to(Vec3 p) {
        if (fixed_axis != kNoAxis) p[fixed_axis] = triangles[0][0][fixed_axis];
        for (auto& t : triangles) t[0] = p;
    }
    bool curved() const { return !bulges.empty(); }
    CurvedTriangle surface(std::size_t row) const { return {triangles[row], bulges[row]}; }
};

class CollapseMesh {
  public:
    /// `safe_height`: faces that are higher may be as long as they like.
    explicit CollapseMesh(const TriangleMesh& mesh, bool curved = false, std::optional<AxisPlane> mirror = {},
                          double safe_height = std::numeric_limits<double>::infinity());

    const Vec3& point(std::int32_t v) const { return points_[static_cast<std::size_t>(v)]; }
    const Triangle& face(std::int32_t f) const { return faces_[static_cast<std::size_t>(f)]; }
    const std::vector<std::int32_t>& faces_at(std::int32_t v) const {
        return at_[static_cast<std::size_t>(v)];
    }
    bool curved() const { return !bulges_.empty(); }
    std::size_t vertex_count() const { return points_.size(); }
    std::size_t face_count() const { return alive_; }
    std::array<Vec3, 3> corners(std::int32_t f) const {
        return {point(face(f)[0]), point(face(f)[1]), point(face(f)[2])};
    }

    /// Every edge once, lower vertex first, in rising order.
    std::vector<std::array<std::int32_t, 2>> edges() const;
    /// The other ends of the edges at v, sorted; unless `all`, of those edges only that do not have two
    /// faces.
    std::vector<std::int32_t> neighbours(std::int32_t v, bool all = true) const;
    /// Vertices on the mirror's plane stay there.
    bool on_mirror(std::int32_t v) const { return mirror_ && point(v)[mirror_->axis] == mirror_->at; }
    /// The link condition, and no two faces that would cover each other; u and v are the ends of an edge.
    bool may_collapse(std::int32_t u, std::int32_t v) const;

    /// Fills `patch` (kept for its memory) with the move of v to p, or of the collapse of u into v at p. A
    /// move keeps the bulges, a collapse makes those at v zero.
    void patch_of_move(std::int32_t v, const Vec3& p, Patch& patch) const;
    void patch_of_collapse(std::int32_t u, std::int32_t v, const Vec3& p, Patch& patch) const;
    /// Face f as it is.
    void patch_of_face(std::int32_t f, Patch& patch) const;
    /// No triangle of the patch is turned over, or folded onto a line, nor reaches the mirror's plane.
    bool keeps_orientation(const Patch& patch) const;

    /// Makes `patch`, of a move of v or of a collapse of u into v, the surface.
    void move(std::int32_t v, const Patch& patch);
    void collapse(std::int32_t u, std::int32_t v, const Patch& patch);

    /// Divides the faces at an edge at its middle, which leaves their surface as it is; returns the
    /// new vertex.
    std::int32_t split(std::int32_t u, std::int32_t v);
    /// Faces that there have ever been: no id of a face is as high.
    std::size_t face_ids() const { return faces_.size(); }

    /// The bulge of edge k of face f (from corner k to the next).
    const Vec3& bulge(std::int32_t f, std::size_t k) const { return bulges_[static_cast<std::size_t>(f)][k]; }
    void set_bulge(std::int32_t f, std::size_t k, const Vec3& b) {
        bulges_[static_cast<std::size_t>(f)][k] = b;
    }

    /// The faces that are left, with the vertices in use.
    TriangleMesh result() const;
    /// Those faces, in the same order.
    std::vector<std::int32_t> faces_left() const;
    /// Those vertices, in rising order.
    std::vector<std::int32_t> vertices_left() const;

  private:
    bool may_meet_mirror(std::int32_t u, std::int32_t v) const;
    /// Empties the patch; returns the place p of its moving vertex, which is on the mirror's plane or not.
    Vec3 begin(Patch& patch, Vec3 p, bool on_mirror) const;

    std::optional<AxisPlane> mirror_;
    double safe_height_;
    std::vector<Vec3> points_;
    std::vector<Triangle> faces_;              // a removed one: -1, -1, -1
    std::vector<std::array<Vec3, 3>> bulges_;  // of each face, or empty: all are flat
    std::vector<std::vector<std::int32_t>> at_;
    std::size_t alive_ = 0;
};

}  // namespace pfgeom
