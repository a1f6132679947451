// A model, or a mesh, made ready for rays.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/triangle_mesh.h"
#include "pfgeom/render/box_tree.h"
#include "pfgeom/render/combined_ray.h"
#include "pfgeom/render/ray_target.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pfgeom {

/// Immutable, safe to use from many threads; made once, kept for many rays. The surface is that of all
/// objects and their copies, whatever lies within another one included; of set operations it is that between
/// inside and outside of the result.
class RayScene {
  public:
    explicit RayScene(const Model& model, const Task& task = {});
    /// The mesh's triangles as one object, number 0.
    explicit RayScene(const TriangleMesh& mesh, const Task& task = {});

    SurfaceHit first_hit(const Ray& ray, const RaySpan& span = {}) const;
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
