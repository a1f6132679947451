// Bounding volume hierarchy over the triangles of a mesh, in double precision: closest point, rays and the
// generalised winding number. Immutable after construction, safe to query from many threads.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace pfgeom {

struct ClosestPoint {
    std::int32_t face = -1;  ///< -1: nothing within the given distance
    Vec3 point;
    double squared_distance = std::numeric_limits<double>::infinity();
};

struct RayHit {
    std::int32_t face = -1;
    double t = 0;
};

/// Closest point of the triangle abc to p (Ericson, "Real-time collision detection", 2005, sec. 5.1.5).
Vec3 closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Four children and their boxes, side by side so that one loop tests all four. Unused children: empty boxes.
struct BvhNode {
    std::array<std::array<double, 4>, 3> lo, hi;  // axis by child
    std::array<std::int32_t, 4> first;            // of the triangles in tree order, or the child's node
    std::array<std::int32_t, 4> count;            // triangles of a leaf; 0: `first` is a node
};

/// A cluster of triangles seen from far away.
struct BvhDipole {
    Vec3 centre, area_normal;
    double radius = 0;
};

class Bvh {
  public:
    /// Copies what it needs; the mesh may go. An empty mesh is allowed (nothing is ever close).
    explicit Bvh(const TriangleMesh& mesh, const Task& task = {});

    /// Closest point of the surface. `within`: only look this far. `hint`: a face that is probably close
    /// (e.g. the answer of a neighbouring query), or -1; it changes the speed only, unless a point that is as
    /// close as `enough` will do: then the first one found.
    ClosestPoint closest(const Vec3& p, double within = std::numeric_limits<double>::infinity(),
                         std::int32_t hint = -1, double enough = -1) const;

    /// From one face to a triangle: the distance is convex, so no point is farther than the farthest corner.
    double farthest_corner(const std::array<Vec3, 3>& triangle, std::int32_t face) const;

    /// Adds the faces that are within `distance` of p, in no particular but always the same order.
    void faces_within(const Vec3& p, double distance, std::vector<std::int32_t>& faces) const;

    /// First hit with t in [t_min, t_max] of origin + t * direction.
    RayHit first_hit(const Vec3& origin, const Vec3& direction, double t_min = 0,
                     double t_max = std::numeric_limits<double>::infinity()) const;

    /// Generalised winding number: 1 inside a closed outward-oriented surface, 0 outside, in between near
    /// holes. Jacobson et al. 2013; far clusters by the dipole of Barill et al. 2018 with `accuracy` beta.
    double winding_number(const Vec3& p, double accuracy = 2.3) const;

    /// > 0 inside: distance to the surface with the sign of the winding number (inside above 1/2).
    double signed_distance(const Vec3& p) const;

    Box bounds() const { return bounds_; }

  private:
    double solid_angle(const Vec3& p, std::int32_t triangle) const;

    Box bounds_;
    std::vector<BvhNode> nodes_;                     // the root first, parents before children
    std::vector<std::array<BvhDipole, 4>> dipoles_;  // of the children of each node
    std::vector<Vec3> corners_;                      // three a face, in tree order
    std::vector<std::int32_t> faces_;                // tree order -> face
    std::vector<std::int32_t> position_;             // face -> tree order
};

}  // namespace pfgeom
