// The whole model as one field: value, gradient and inside/outside at world points.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/eval/function_field.h"
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
    /// Of a combination: max, min, and min with the negative of its operands' values, exactly.
    double value(const Vec3& world) const;
    /// Gradient of value, per world unit.
    Vec3 gradient(const Vec3& world) const;
    bool contains(const Vec3& world) const { return value(world) >= 0; }
    Box bounds() const;  ///< world box that holds the surface of every object

  private:
    struct Part;
    struct Node;
    void add_parts(const Model& model, const CombinationNode& operand);
    Node node_of(const CombinationNode& what) const;
    const Node& node_at(std::int32_t index) const;
    Jet jet(const Vec3& p) const;
    Jet operand_jet(std::int32_t first, std::int32_t last, const Vec3& p) const;
    Jet jet(std::int32_t index, const Vec3& p) const;

    std::vector<std::unique_ptr<Part>> parts_;  // of each object
    std::vector<Node> nodes_;                   // the root last
};

}  // namespace pfgeom
