#include "pfgeom/fit/thin.h"

#include "pfgeom/fit/collapse.h"

namespace pfgeom {
namespace {

// Samples on large faces, for each face: without a limit it takes twice the time (fandisk, tri-plate_holes
// and tri-featuretype at 1e-3), and the number of faces differs by 1 to 4 %, either way.
constexpr double kSamplesOfFace = 4;

}  // namespace

TriangleMesh thinned(const TriangleMesh& mesh, double distance, const Task& task) {
    CollapseMesh work(mesh);  // no slivers, unlike mesh parts, which want few bytes
    CollapseError error(mesh, Metric::max, distance, collapse_spacing(mesh, distance, kSamplesOfFace), task);
    collapse_edges(work, error, {Metric::max, distance, distance, diagonal(mesh), true}, task);
    return work.result();
}

}  // namespace pfgeom
