#include "pfgeom/function/quadric_shape.h"

#include "pfgeom/function/principal_axes.h"
#include "pfgeom/function/quadric_form.h"
#include "pfgeom/function/turned_quadric.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

constexpr std::size_t kMostFitted = 64;  // spots that a form is fitted to; all of them are checked

constexpr std::array<std::string_view, kQuadricKinds> kNames{
    "plane",
    "parallel planes",
    "crossing planes",
    "sphere",
    "spheroid",
    "ellipsoid",
    "circular cylinder",
    "elliptic cylinder",
    "parabolic cylinder",
    "hyperbolic cylinder",
    "circular cone",
    "elliptic cone",
    "circular paraboloid",
    "elliptic paraboloid",
    "hyperbolic paraboloid",
    "one-sheet hyperboloid of revolution",
    "one-sheet hyperboloid",
    "two-sheet hyperboloid of revolution",
    "two-sheet hyperboloid",
    "line",
    "point",
    "nothing",
};

// The piece of a quadric that is used, moved and scaled into the unit ball.
struct Piece {
    Vec3 middle;
    double reach = 0;
    std::vector<SurfaceSpot> spots;
};

Piece piece_of(const Quadric& q, std::span<const Vec3> points) {
    Piece piece;
    for (const Vec3& p : points) piece.middle += p / static_cast<double>(points.size());
    for (const Vec3& p : points) piece.reach = std::max(piece.reach, norm(p - piece.middle));
    if (!(piece.reach > 0)) return piece;
    for (const Vec3& p : points) {
        const Vec3 inwards = normalized(q.gradient(p));
        if (inwards != Vec3{}) piece.spots.push_back({(p - piece.middle) / piece.reach, inwards});
    }
    return piece;
}

// Every so manieth one.
std::vector<SurfaceSpot> some_of(const std::vector<SurfaceSpot>& spots) {
    const std::size_t count = std::min(spots.size(), kMostFitted);
    std::vector<SurfaceSpot> some(count);
    for (std::size_t i = 0; i < count; ++i) some[i] = spots[i * spots.size() / count];
    return some;
}

// The quadric's own, and those of its normals' directions and of how they differ: where a piece is small, the
// quadric's axes say little.
std::array<std::array<Vec3, 3>, 3> frames_of(const Quadric& q, std::span<const SurfaceSpot> spots) {
    Vec3 mean;
    for (const SurfaceSpot& s : spots) mean += s.inwards / static_cast<double>(spots.size());
    const auto spread = [&](const Vec3& about) {
        std::array<Vec3, 3> rows{};
        for (const SurfaceSpot& s : spots) {
            const Vec3 d = s.inwards - about;
            for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(i)] += d[i] * d;
        }
        return principal_axes(rows).axes;
    };
    return {turned(q, {}).axes, spread({}), spread(mean)};
}

// Back from the unit ball.
TurnedQuadric moved_back(TurnedQuadric q, const Piece& piece) {
    q.origin = piece.middle;
    for (double& s : q.squares) s /= piece.reach * piece.reach;
    for (double& l : q.linear) l /= piece.reach;
    return q;
}

}  // namespace

std::string_view name_of(QuadricKind kind) {
    return kNames[static_cast<std::size_t>(kind)];
}

QuadricShape shape_of(const Quadric& quadric) {
    return shape_of(turned(quadric, {}));
}

QuadricShape shape_of(const Quadric& quadric, std::span<const Vec3> points, double tolerance) {
    const Piece piece = points.empty() ? Piece{} : piece_of(quadric, points);
    const QuadricShape as_it_is = shape_of(turned(quadric, piece.middle));
    if (piece.spots.empty()) return as_it_is;
    const std::vector<SurfaceSpot> some = some_of(piece.spots);
    const auto frames = frames_of(quadric, some);
    const double limit = tolerance / piece.reach;
    for (const QuadricForm& form : quadric_forms()) {
        if ((form.simplifies >> static_cast<unsigned>(as_it_is.kind) & 1U) == 0) continue;
        TurnedQuadric found;
        if (fit_form(form, some, limit, frames, found) && follows(found, piece.spots, limit))
            return shape_of(moved_back(found, piece));
    }
    return as_it_is;
}

}  // namespace pfgeom
