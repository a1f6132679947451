// Where labelled faces, edges and vertices belong: on the zero sets of their quadrics.
#pragma once

#include "pfgeom/eval/pruned_tree.h"
#include "pfgeom/polygonize/tree_boundary.h"

#include <span>

namespace pfgeom {

class LabelSurface {
  public:
    explicit LabelSurface(const TreePruner& tree) : tree_(tree) {}

    /// Unit, towards the outside; 0 where the gradient is.
    Vec3 normal(Label label, const Vec3& p) const {
        return normalized(quadric(label).gradient(p) * (label % 2 == 0 ? -1.0 : 1.0));
    }
    /// To first order; infinite or not a number where the gradient vanishes.
    double distance(Label label, const Vec3& p) const {
        return std::abs(quadric(label).value(p)) / norm(quadric(label).gradient(p));
    }
    /// Sine of the least angle between zero sets at which their intersection is looked for. At smaller ones
    /// it is far away, or not there, and the first of them is within the tolerance of the others.
    static constexpr double kLeastSine = 0.05;
    /// The same for the two sides of a crease: in a valley of one degree too the bottom is what counts.
    static constexpr double kLeastSineOfCreases = 0.01;

    /// Moves p to where all the labels' zero sets meet (those that cross the earlier ones at a clear angle).
    /// False, and p as before, where that is further than `reach` away.
    bool project(std::span<const Label> labels, double reach, double accuracy, Vec3& p,
                 double least_sine = kLeastSine) const;

  private:
    const Quadric& quadric(Label label) const { return tree_.quadric(label / 2); }
    Vec3 step(std::span<const Label> labels, const Vec3& p, double least_sine) const;

    const TreePruner& tree_;
};

}  // namespace pfgeom
