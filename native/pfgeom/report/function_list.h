// What the functions of a model are: planes, cylinders, cones … with their places in the world, for people
// and for other programs.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"
#include "pfgeom/function/quadric_shape.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

struct ListedFunction {
    std::int32_t object = 0;  ///< the first that it is part of
    std::int32_t copies = 1;  ///< of that object
    /// In the mesh's units, in the first of the copies; of the base, if there are perturbations.
    QuadricShape shape;
    std::int64_t perturbations = 0;  ///< with a form factor
    /// Is it a surface of the object? Else it only tells parts of space from each other, or trims a sheet.
    bool surface = true;
    /// Of a set tree's quadric: estimate of its part of one copy's surface; else, and where an operand is
    /// sheared, 0: not known.
    double area = 0;
    /// Of spheres, circular cylinders and cones of set trees: the solid lies outside of it, as of a hole.
    bool hollow = false;
};

/// The quadrics of set trees in their order, the functions of other objects; none of mesh parts. A quadric is
/// the simplest shape that stays within the model's tolerance of it over its part of the surface.
std::vector<ListedFunction> list_functions(const Model& model, const Task& task = {});

}  // namespace pfgeom
