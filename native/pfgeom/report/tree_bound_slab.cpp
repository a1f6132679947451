// The slab test. Let B be the ball around the cell, enlarged by the tolerance, n the outward normal at q, the
// point of the mesh closest to the centre, and l(x) = n·(x - q). Let every facet that meets B face upwards
// (n · its normal > 0) and lie where |l - m| <= w < tolerance, within B. Then
// (1) the line through q along n crosses the mesh within B at q alone, upwards, for it would have to come
//     back between two crossings. What of B is above the slab is connected and free of facets, hence outside
//     if the line gets there within B; below, inside.
// (2) a point x of the cell with |l(x) - m| <= tolerance - w is within the tolerance of the mesh: the line
//     through x along n leads from inside to outside between l = m - w and l = m + w, which is within B.
// So the cell holds if the tree says `outside` where l >= m + tolerance - w and `inside` where
// l <= m - tolerance + w.
//
// A prototype of this test asked that one facet cover the cell: fandisk's certificate took 1.9 million cells,
// now 0.5 million.
#include "pfgeom/report/tree_bound_slab.h"

#include <cmath>

namespace pfgeom {
namespace {

constexpr double kFacing = 1e-3;  // n · normal of the facets
constexpr double kThin = 0.95;    // w, in tolerances

// l over the part of a face within the ball; false: it does not face upwards.
bool grow_slab(const SurfaceSides& sides, std::int32_t face, const Vec3& n, const Vec3& q, const Vec3& centre,
               double ball, Interval& slab) {
    const Vec3 normal = sides.face_normal(face);
    const double facing = dot(n, normal);
    if (!(facing > kFacing)) return false;
    double lo = Box::kInf, hi = -Box::kInf;
    for (const std::int32_t v : sides.mesh().faces[face]) {
        const double level = dot(n, sides.mesh().vertices[v] - q);
        lo = std::min(lo, level), hi = std::max(hi, level);
    }
    if (lo < slab.lo || hi > slab.hi) {  // of the face's plane, the disc within the ball
        const double height = dot(normal, centre - sides.mesh().vertices[sides.mesh().faces[face][0]]);
        const double level = dot(n, centre - normal * height - q);
        const double disc = std::sqrt(std::max(ball * ball - height * height, 0.0));
        const double slope = norm(n - normal * facing) * disc;
        lo = std::max(lo, level - slope), hi = std::min(hi, level + slope);
    }
    slab = {std::min(slab.lo, lo), std::max(slab.hi, hi)};
    return true;
}

}  // namespace

bool holds_around_slab(const TreeBoundProblem& problem, const TreeBoundCell& cell,
                       std::vector<std::int32_t>& faces, PrunedTree& part) {
    const Vec3 centre = cell.centre(), half = cell.half(), q = cell.closest.point;
    const Vec3 n = problem.sides.normal_at(cell.closest);
    const double ball = cell.radius() + problem.tolerance;
    faces.clear();
    problem.sides.bvh().faces_within(centre, ball, faces);
    Interval slab;
    for (const std::int32_t face : faces) {
        if (!grow_slab(problem.sides, face, n, q, centre, ball, slab)) return false;
        if (!(slab.hi - slab.lo < 2 * kThin * problem.tolerance)) return false;
    }
    const double beyond = problem.tolerance - (slab.hi - slab.lo) / 2, middle = (slab.lo + slab.hi) / 2;
    const double level = dot(n, centre - q);
    const double on_line = std::sqrt(std::max(ball * ball - squared_norm(centre - q - n * level), 0.0));
    if (!(level + on_line > slab.hi && level - on_line < slab.lo)) return false;
    const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
    for (const double up : {1.0, -1.0}) {
        const double border = up * middle + beyond;
        if (up * level + reach < border) continue;  // the cell does not reach so far
        const KnownAnswer above = known_half_space(n * up, up * dot(n, q) + border);
        problem.pruner.prune(cell.tree, cell.box, true, {&above, 1}, part);
        if (part[0].question >= 0 || part[0].inside != (up < 0)) return false;
    }
    return true;
}

}  // namespace pfgeom
