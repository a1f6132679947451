#include "pfgeom/compress/mirror_pose.h"

#include "pfgeom/function/frame.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

// Of the tolerance: how far an end of the shape may be turned out of the plane.
constexpr double kTurnShare = 1.0 / 32;
// Eighths of octaves of the turn's steps, up to Placements::kMostSteps.
constexpr int kFinestTurn = 8 * 20;
// Steps of places against the half edge of the frame: so that the frame's centre is in the origin.
constexpr int kPlaceCode = -8 * 7;

int nearest_axis(const Vec3& n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

Vec3 column(const std::array<Vec3, 3>& rows, int k) {
    return {rows[0][k], rows[1][k], rows[2][k]};
}

// The least turn that brings an axis to n.
std::array<Vec3, 3> turn_to(int axis, const Vec3& n) {
    Vec3 from;
    from[axis] = 1;
    const Vec3 v = cross(from, n);
    return rotation_of({1 + n[axis], v.x, v.y, v.z});
}

// The coarsest that turns the axis to n, or nearly.
bool choose_turn(int axis, const Vec3& n, double error, Placements& placements) {
    const std::array<Vec3, 3> exact = turn_to(axis, n);
    Placement& placement = placements.list.front();
    for (int code = 0; code <= kFinestTurn; ++code) {
        placements.turn_steps = static_cast<std::int32_t>(std::floor(exp2_eighths(code) + 0.5));
        placement.turn = quantise_turn(exact, placements.turn_steps);
        if (norm(column(placements.similarity(0, {}).rows, axis) - n) <= error) return true;
    }
    return false;
}

}  // namespace

std::optional<MirrorPose> mirror_pose(const Goal& goal, const std::optional<Mirror>& mirror) {
    if (!mirror) return {};
    const int axis = nearest_axis(mirror->normal);
    const double sign = mirror->normal[axis] < 0 ? -1 : 1;
    const Vec3 n = mirror->normal * sign;
    if (n[axis] == 1) return MirrorPose{{axis, sign * mirror->at}, goal.mesh, {}};
    if (goal.is_pattern) return {};

    MirrorPose pose{{axis, 0}, goal.mesh, {}};
    Placements& placements = pose.placements;
    placements.list.resize(1);
    if (!choose_turn(axis, n, kTurnShare * goal.tolerance / goal.bvh.bounds().diagonal(), placements))
        return {};
    const auto turn_mesh = [&] {
        const Similarity s = placements.similarity(0, {});
        for (std::size_t v = 0; v < pose.mesh.vertices.size(); ++v)
            pose.mesh.vertices[v] = s.apply_inverse(goal.mesh.vertices[v]);
    };
    turn_mesh();
    const Box box = bounds(pose.mesh);
    const Vec3 centre = placements.similarity(0, {}).apply(box.centre());
    placements.step_code = Frame::around(box).scale_code + kPlaceCode;
    for (std::size_t k = 0; k < 3; ++k) {
        const double place =
            std::floor(centre[static_cast<int>(k)] / exp2_eighths(placements.step_code) + 0.5);
        if (!(std::abs(place) < static_cast<double>(Frame::kMaxOffset))) return {};
        placements.origin[k] = static_cast<std::int64_t>(place);
    }
    normalise(placements);
    turn_mesh();
    pose.plane.at = sign * mirror->at - dot(n, placements.similarity(0, {}).translation);
    const bool centred = Frame::around(bounds(pose.mesh)).offset == std::array<std::int64_t, 3>{};
    return centred && find_flaw(placements).empty() ? std::optional(std::move(pose)) : std::nullopt;
}

}  // namespace pfgeom
