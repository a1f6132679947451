// A free form with borders: closed, fitted like a closed one, and its surface cut along the borders by a
// decision tree of planes, which is found as that of two materials is.
#include "pfgeom/compress/hierarchy_search.h"
#include "pfgeom/compress/labelled_surface.h"
#include "pfgeom/compress/paint_fit.h"
#include "pfgeom/compress/shorten_borders.h"
#include "pfgeom/mesh/close_holes.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

// Of the surface, the most that may be missing: what closes holes is fitted like all else.
constexpr double kMostMissing = 0.25;
// How far a border may be off: of the maximum; or as a strip as wide would add so much to the rms, squared.
// The borders of scans are jagged (bunny at 5e-4: 765 bytes of planes at 4 tolerances, 430 at 7, 200 at 12).
// At most 2^(kMostBorder / 8) tolerances.
constexpr double kBorderOfMax = 0.9, kBorderShare = 0.3;
constexpr int kMostBorder = 36;

// Cuts the solid's surface along the borders.
class Opener {
  public:
    Opener(const Goal& goal, const ClosedIsland& closed, const Task& task)
        : goal_(goal),
          surface_(closed.mesh, parts_of(closed), false),
          tolerance_(border_tolerance()),
          task_(task) {}

    void operator()(Outcome& solid) const {
        const Model model = model_of(goal_, solid);
        PaintFit fit(model, model.objects.front(), tolerance_, 2, goal_.effort, task_);
        const PaintedCopy here{&surface_, {}};
        PaintError error;
        Paint paint = fit.fit({&here, 1}, error);
        MaterialTree& tree = paint.trees.front();
        shorten_borders(fit.mesh(), solid.object.frame, {surface_, tolerance_}, tree, task_);
        solid.candidate = "sheet";
        solid.object.shape = Sheet{0, -1, std::move(tree)};
    }

  private:
    static std::vector<std::int32_t> parts_of(const ClosedIsland& closed) {
        std::vector<std::int32_t> parts(closed.mesh.faces.size(), Sheet::kCut);
        std::fill_n(parts.begin(), closed.own_faces, Sheet::kKept);
        return parts;
    }

    // A strip of width w and length l adds l w³ / 3 to the area times the square of the rms.
    double border_tolerance() const {
        const double t = goal_.tolerance;
        if (goal_.metric == Metric::max) return kBorderOfMax * t;
        double length = 0;
        for (const BorderEdge& e : surface_.borders()) length += norm(e.to - e.from);
        const double most = 3 * kBorderShare * surface_area(goal_.mesh) * t * t;
        int code = kMostBorder;
        const auto width = [&] { return t * exp2_eighths(code); };
        while (code > 0 && length * width() * width() * width() > most) --code;
        return width();
    }

    const Goal& goal_;
    LabelledSurface surface_;
    double tolerance_;  // of the borders
    const Task& task_;
};

}  // namespace

std::optional<Outcome> try_open_hierarchy(const Goal& goal, std::size_t most_bytes, const Task& task) {
    const ClosedIsland closed = close_holes(goal.mesh);
    const double own = surface_area(goal.mesh), missing = surface_area(closed.mesh) - own;
    if (missing > kMostMissing * own) return {};
    return search_hierarchy(goal, closed, Opener(goal, closed, task), most_bytes, task);
}

}  // namespace pfgeom
