// Where labelled faces, edges and vertices belong: on the zero sets of their questions.
#pragma once

#include "pfgeom/eval/function_field.h"
#include "pfgeom/polygonize/cut_solid.h"
#include "pfgeom/polygonize/tree_boundary.h"

#include <span>
#include <vector>

namespace pfgeom {

class LabelSurface {
  public:
    explicit LabelSurface(const CutSolid& solid) : solid_(solid) {}

    /// Unit, towards the outside; 0 where the gradient is.
    Vec3 normal(Label label, const Vec3& p) const {
        return normalized(jet(label, p).gradient * (label % 2 == 0 ? -1.0 : 1.0));
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
    struct Known {
        std::int32_t question = -1;
        Vec3 p;
        Jet jet;
    };
    // Of a field only once in a while: the same few vertices are asked for again and again.
    Jet jet(Label label, const Vec3& p) const;
    Vec3 step(std::span<const Label> labels, const Vec3& p, double least_sine) const;

    const CutSolid& solid_;
    mutable std::vector<Known> known_;  // of fields; one thread has one surface
};

}  // namespace pfgeom
