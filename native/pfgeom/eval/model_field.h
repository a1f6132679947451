// The whole model as one field: value, gradient and inside/outside at world points.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/function/model.h"

#include <memory>
#include <vector>

namespace pfgeom {

/// Immutable, safe from many threads. Made once for a model, kept for many queries.
class ModelField {
  public:
    explicit ModelField(const Model& model);
    ~ModelField();
    ModelField(ModelField&&) noexcept;
    ModelField& operator=(ModelField&&) noexcept;

    /// > 0 inside the union of the objects, in the world's units near the surface (approximately a distance).
    double value(const Vec3& world) const;
    /// Gradient of value, per world unit.
    Vec3 gradient(const Vec3& world) const;
    bool contains(const Vec3& world) const { return value(world) >= 0; }
    Box bounds() const;  ///< world box that holds the surface of every object

  private:
    struct Part;
    std::vector<std::unique_ptr<Part>> parts_;
};

}  // namespace pfgeom
