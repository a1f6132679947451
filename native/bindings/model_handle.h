// A model with its bytes and, once somebody asks for values or casts rays, what that takes.
#pragma once

#include "pfgeom/eval/model_field.h"
#include "pfgeom/function/model.h"
#include "pfgeom/render/scene.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace pfgeom::bindings {

class ModelHandle {
  public:
    /// `bytes`: what `model` was decoded from.
    ModelHandle(Model model, std::vector<std::uint8_t> bytes)
        : model_(std::move(model)), bytes_(std::move(bytes)) {}

    const Model& model() const { return model_; }
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }
    /// Made at the first call; safe from many threads. To be called without the interpreter's lock.
    const ModelField& field() const {
        std::call_once(once_, [this] { field_.emplace(model_); });
        return *field_;
    }
    /// Likewise, for rays. A call that is stopped leaves nothing behind; the next one begins anew.
    const RayScene& scene(const Task& task) const {
        std::call_once(scene_once_, [&] { scene_.emplace(model_, task); });
        return *scene_;
    }

  private:
    Model model_;
    std::vector<std::uint8_t> bytes_;
    mutable std::once_flag once_;
    mutable std::optional<ModelField> field_;
    mutable std::once_flag scene_once_;
    mutable std::optional<RayScene> scene_;
};

using ModelPointer = std::shared_ptr<ModelHandle>;

}  // namespace pfgeom::bindings
