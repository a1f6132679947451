// Which of a tree's questions its surface is made of, and where: rays through the box, cut exactly by the
// tree.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/set_tree.h"

#include <array>
#include <vector>

namespace pfgeom {

/// What one quadric contributes to the surface, as far as rays have met it.
struct QuadricPatch {
    std::vector<Vec3> points;  ///< on the quadric and on the surface
    double area = 0;           ///< estimate
    double area_above = 0;     ///< … of that where the solid is on the quadric's positive side
};

struct TreeSurface {
    std::vector<QuadricPatch> patches;  ///< of each quadric
    double cut_area = 0;                ///< where a cut across an axis is the surface
    std::array<double, 6> box_area{};   ///< of the box's sides: low x, high x, low y …
};

/// `steps`² rays along each axis at least. Where a quadric is met seldom, rays are shot once more, densely,
/// through what is known of it; where it is not met, four times as densely through the box. What is then not
/// met only tells parts of space from each other, but for bits of surface smaller than the rays' distance.
/// Trees of many thousand nodes get fewer rays.
TreeSurface find_surface(const SetTree& tree, const Task& task = {}, int steps = 48);

/// Points where rays through a box meet a quadric.
std::vector<Vec3> points_on(const Quadric& quadric, const Box& box, int steps = 12);

}  // namespace pfgeom
