// A model, or a mesh as arrays, as one thing that rays can meet.
#pragma once

#include "arrays.h"
#include "model_handle.h"

#include <memory>
#include <utility>
#include <variant>

namespace pfgeom::bindings {

using MeshArrays = std::pair<Points, Indices>;  // vertices and faces
using ShapeArgument = std::variant<ModelPointer, MeshArrays>;

/// Owns what it makes a scene of.
class ShapeHandle {
  public:
    explicit ShapeHandle(const ShapeArgument& shape) {
        if (const auto* arrays = std::get_if<MeshArrays>(&shape)) {
            mesh_ = std::make_shared<const TriangleMesh>(mesh_from(arrays->first, arrays->second));
        } else {
            model_ = std::get<ModelPointer>(shape);
        }
    }

    /// A model's is shared with other calls.
    std::shared_ptr<const RayScene> scene(const Task& task) const {
        if (model_) return {model_, &model_->scene(task)};
        return std::make_shared<const RayScene>(*mesh_, task);
    }

  private:
    ModelPointer model_;
    std::shared_ptr<const TriangleMesh> mesh_;
};

}  // namespace pfgeom::bindings
