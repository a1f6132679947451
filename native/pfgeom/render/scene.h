// A model, or a mesh, made ready for rays.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/render/box_tree.h"
#include "pfgeom/render/combined_ray.h"
#include "pfgeom/render/ray_target.h"

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pfgeom {

/// Of a surface, to some other point.
struct NearestPoint {
    Vec3 point;
    double distance = std::numeric_limits<double>::infinity();  ///< infinity: there is no surface
    double proved = std::numeric_limits<double>::infinity();    ///< no surface is nearer
    std::int32_t object = -1;                                   ///< row of Model::objects
};

/// Immutable, safe to use from many threads; made once, kept for many rays. The surface is that of all
/// objects and their copies, whatever lies within another one included; of set operations it is that between
/// inside and outside of the result.
class RayScene {
  public:
    explicit RayScene(const Model& model, const Task& task = {});
    /// The mesh's triangles as one object, number 0.
    explicit RayScene(const TriangleMesh& mesh, const Task& task = {});

    SurfaceHit first_hit(const Ray& ray, const RaySpan& span = {}) const;
    /// The point of the surface nearest to p, and a proof that none is nearer than `accuracy` less (or as far
    /// as a budget of work goes). Curved faces of mesh parts count as triangles within 1e-5 of the diagonal.
    /// Only where keeps_distances().
    NearestPoint nearest(const Vec3& p, double accuracy, ExtremeSearch& search) const;
    /// Neither set operations, nor operands with transforms that change the ratios of distances.
    bool keeps_distances() const;
    /// The smallest box that holds the surface, but for `accuracy`; empty if there is none. Of set operations
    /// a larger one.
    Box bounds(double accuracy, const Task& task = {}) const;
    /// Boxes that hold the surface together, in some detail; none if there is no surface.
    std::vector<Box> cover() const;

  private:
    /// The objects of an operand, wherever they lie; `boxes` are those of the pieces.
    void add(const Model& model, const CombinationNode& operand, std::vector<Box>& boxes, const Task& task);
    void add_piece(const RayPiece& piece, const Box& box, std::vector<Box>& boxes);

    std::vector<std::unique_ptr<RayTarget>> targets_;  // of each object
    std::vector<RayPiece> pieces_;
    BoxTree boxes_;                           // of the pieces
    std::optional<CombinedPieces> combined_;  // if there are set operations
};

}  // namespace pfgeom
