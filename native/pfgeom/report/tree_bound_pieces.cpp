// Faces are bisected until a piece is settled. Two ways to settle it:
// (1) across: the tree has one label on the piece moved along its normal by the tolerance, and the other on
//     the piece moved against it. Settles whole faces on smooth parts.
// (2) around: both labels within tolerance - R of the centroid of a piece of radius R. For creases and
//     corners, where the model may lie aside of the normal.
#include "pfgeom/report/tree_bound_pieces.h"

#include "pfgeom/report/tree_bound_ball.h"

#include <array>
#include <cmath>

namespace pfgeom {
namespace {

// In tolerances: pieces this small are settled around their centroid; the quadrics are asked from the second
// on, and the third are given up. So are those of the fourth that have no change within the furthest
// distance.
constexpr double kAroundBelow = 0.65, kQuadricsBelow = 1.0 / 8, kGiveUp = 1.0 / 32, kBareBelow = 4;
constexpr double kStep = 1.0 / 64, kFurthest = 2;  // of the distances tried for pieces that are given up
constexpr std::int64_t kEnoughLost = 64;           // a group of faces ends with so many
constexpr double kDeep = 0.93;                     // where a missing label is looked for
constexpr std::size_t kMissedKept = 64;            // of a group of faces
constexpr double kSlack = 1e-12;                   // for what moving points and planes is off by

Box around(const Corners& piece, double distance) {
    Box box;
    for (const Vec3& p : piece) box.grow(p);
    const Vec3 margin{distance, distance, distance};
    return {box.lo - margin, box.hi + margin};
}

}  // namespace

void PieceSearch::run(std::span<const std::int32_t> faces) {
    const double reach = kFurthest * problem_.tolerance;
    Box box;
    for (const std::int32_t face : faces) box.grow(around(corners_of(problem_.sides.mesh(), face), reach));
    PrunedTree tree;
    problem_.pruner.prune(problem_.pruner.whole(), box, false, {}, tree);
    for (const std::int32_t face : faces)
        descend(corners_of(problem_.sides.mesh(), face), problem_.sides.face_normal(face), tree, 0);
}

void PieceSearch::descend(const Corners& piece, const Vec3& normal, const PrunedTree& parent,
                          std::size_t level) {
    problem_.task.check();
    if (!found_.complete) return;
    ++found_.counts.pieces;
    if (level == levels_.size()) levels_.emplace_back();
    PrunedTree& tree = levels_[level];
    const double tolerance = problem_.tolerance, conceded = tolerance + found_.excess;
    problem_.pruner.prune(parent, around(piece, kFurthest * tolerance), true, {}, tree);
    if (settled(piece, normal, tree, tolerance)) return;
    if (found_.excess > 0 && settled(piece, normal, tree, conceded)) return miss(piece);
    const double size = radius(piece, centroid(piece));
    if (tree[0].question < 0 && size < kBareBelow * tolerance) return lose(piece);
    if (size < kGiveUp * tolerance) return concede(piece, normal, tree);
    for (const Corners& half : bisect(piece)) descend(half, normal, tree, level + 1);
}

bool PieceSearch::settled(const Corners& piece, const Vec3& normal, const PrunedTree& tree, double reach) {
    if (tree[0].question < 0) return false;
    if (changes_across(piece, normal, tree, reach)) return true;
    const Vec3 centre = centroid(piece);
    const double size = radius(piece, centre);
    if (size >= kAroundBelow * reach) return false;
    const Ball ball{centre, reach - size};
    if (label_changes_within(problem_.pruner, tree, ball, normal)) return true;
    return size < kQuadricsBelow * reach && label_changes_near_quadrics(problem_.pruner, tree, ball);
}

// Has each of the two copies of the piece, moved along the normal and against it, one label, and not the
// same?
bool PieceSearch::changes_across(const Corners& piece, const Vec3& normal, const PrunedTree& tree,
                                 double reach) {
    std::array<KnownAnswer, 5> known;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 inwards = normalized(cross(normal, piece[(k + 1) % 3] - piece[k]));
        known[k] = known_half_space(inwards, dot(inwards, piece[k]) - kSlack);
    }
    std::array<bool, 2> labels{};
    for (std::size_t side = 0; side < 2; ++side) {
        const Vec3 offset = normal * (side == 0 ? reach : -reach);
        const Corners moved{piece[0] + offset, piece[1] + offset, piece[2] + offset};
        const double level = dot(normal, moved[0]);
        known[3] = known_half_space(normal, level - kSlack);
        known[4] = known_half_space(-normal, -level - kSlack);
        problem_.pruner.prune(tree, around(moved, kSlack), true, known, part_);
        if (part_[0].question >= 0) return false;
        labels[side] = part_[0].inside;
    }
    return labels[0] != labels[1];
}

// The piece holds at a greater distance than the tolerance: so may all pieces after it.
void PieceSearch::concede(const Corners& piece, const Vec3& normal, const PrunedTree& tree) {
    const double tolerance = problem_.tolerance;
    for (double excess = found_.excess; tolerance + excess < kFurthest * tolerance;
         excess += kStep * tolerance) {
        problem_.task.check();
        if (!settled(piece, normal, tree, tolerance + excess)) continue;
        found_.excess = excess;
        return miss(piece);
    }
    lose(piece);
}

void PieceSearch::lose(const Corners& piece) {
    ++found_.counts.lost;
    if (found_.counts.lost > kEnoughLost) found_.complete = false;
    miss(piece);
}

// Keeps the point around the piece at which the model is most wrong: within the tube, but deepest in it.
void PieceSearch::miss(const Corners& piece) {
    ++found_.counts.missed;
    if (found_.missed.size() >= kMissedKept) return;
    const Vec3 centre = centroid(piece);
    LabelledPoint deepest;
    for (const Vec3& direction : spread_directions()) {
        const Vec3 p = centre + direction * (kDeep * problem_.tolerance);
        const SignedClosest closest = problem_.sides.at(p, -1);
        const double depth = std::abs(closest.distance);
        const bool inside = closest.distance > 0;
        if (depth > deepest.distance && problem_.pruner.contains(problem_.pruner.whole(), p) != inside)
            deepest = {p, depth, closest.face, inside};
    }
    if (deepest.face >= 0) found_.missed.push_back(deepest);
}

}  // namespace pfgeom
