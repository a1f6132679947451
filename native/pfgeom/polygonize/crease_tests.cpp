#include "pfgeom/polygonize/crease_tests.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

constexpr double kFacing = 0.3;  // least cosine between a triangle and the normals at its corners
constexpr double kThinnest =
    0.005;  // least height over longest side of new triangles, unless the old are thinner
constexpr int kMostNeighbours = 16;  // of a vertex after a merge
// Sine of the least angle between two quadrics at which their curve's direction means anything.
constexpr double kLeastSine = 0.1;
// Edges that may be merged across creases if that mends a triangle, in tolerances.
constexpr double kShortOf = 0.5;
// Cosine of the normals at an edge so sharp, or a valley so narrow, that the middle of a chord may be far
// from it and near both quadrics.
constexpr double kSharp = -0.5;

double thinness(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double side = std::max({squared_norm(b - a), squared_norm(c - a), squared_norm(c - b)});
    return side > 0 ? norm(cross(b - a, c - a)) / side : 0;
}

}  // namespace

double CreaseTests::height(Label label, std::int32_t a, std::int32_t b) const {
    const Vec3 turn = surface_.normal(label, at(b)) - surface_.normal(label, at(a));
    return std::abs(dot(turn, at(b) - at(a))) / 8;
}

double CreaseTests::distance_to_curve(Label one, Label other, const Vec3& p, double reach) const {
    constexpr double kAccuracy = 1e-3;  // of the edge
    const std::array<Label, 2> both{one, other};
    Vec3 foot = p;
    surface_.project(both, reach, kAccuracy * reach, foot, LabelSurface::kLeastSineOfCreases);
    return norm(foot - p);
}

double CreaseTests::height(Label one, Label other, std::int32_t a, std::int32_t b) const {
    if (one == other) return height(one, a, b);
    double most = std::max(height(one, a, b), height(other, a, b));
    const Vec3 ta = cross(surface_.normal(one, at(a)), surface_.normal(other, at(a)));
    const Vec3 tb = cross(surface_.normal(one, at(b)), surface_.normal(other, at(b)));
    const double sa = norm(ta), sb = norm(tb);
    if (sa > kLeastSine && sb > kLeastSine)
        most = std::max(most, norm(tb / sb - ta / sa) * norm(at(b) - at(a)) / 8);
    if (dot(surface_.normal(one, at(a)), surface_.normal(other, at(a))) < kSharp)
        most = std::max(most, distance_to_curve(one, other, (at(a) + at(b)) / 2, norm(at(b) - at(a))));
    return most;
}

double CreaseTests::height(std::int32_t h) const {
    return height(m_.label_at(h), m_.label_at(m_.mesh.twin(h)), m_.mesh.from(h), m_.mesh.to(h));
}

bool CreaseTests::faces_outside(Label label, const Vec3& a, const Vec3& b, const Vec3& c, double thinnest,
                                double facing) const {
    const Vec3 n = cross(b - a, c - a);
    const double area = norm(n);
    if (!(area > 0) || thinness(a, b, c) < thinnest) return false;
    for (const Vec3* p : {&a, &b, &c})
        if (dot(n, surface_.normal(label, *p)) < facing * area) return false;
    return true;
}

// A vertex within a face goes anywhere; one on a crease along it; one where creases meet stays.
bool CreaseTests::keeps_creases(std::int32_t h) const {
    int creases = 0;
    m_.mesh.for_each_spoke(h, [&](std::int32_t spoke) { creases += m_.crease(spoke); });
    return creases == 0 || (creases == 2 && m_.crease(h));
}

bool CreaseTests::keeps_faces(std::int32_t h, double thinnest, double facing) const {
    const std::int32_t b = m_.mesh.to(h);
    std::int32_t spoke = h;
    do {
        const std::int32_t x = m_.mesh.to(spoke), y = m_.mesh.apex(spoke);
        if (x != b && y != b) {
            const double now = thinness(at(m_.mesh.from(h)), at(x), at(y));
            if (!faces_outside(m_.label_at(spoke), at(b), at(x), at(y), std::min(now, thinnest), facing))
                return false;
        }
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return true;
}

// The edge, and those that merging from(h) into to(h) would make.
bool CreaseTests::keeps_heights(std::int32_t h, double limit) const {
    if (height(h) > limit) return false;
    const std::int32_t b = m_.mesh.to(h);
    std::int32_t spoke = h;
    do {
        const std::int32_t x = m_.mesh.to(spoke);
        if (x != b && height(m_.label_at(spoke), m_.label_at(m_.mesh.twin(spoke)), b, x) > limit)
            return false;
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return true;
}

bool CreaseTests::may_merge(std::int32_t h, double limit) const {
    const int neighbours = m_.mesh.valence(h) + m_.mesh.valence(m_.mesh.twin(h)) - 4;
    return keeps_creases(h) && neighbours <= kMostNeighbours && keeps_heights(h, limit) &&
           keeps_faces(h, kThinnest, kFacing);
}

bool CreaseTests::merge_mends(std::int32_t h, double tolerance) const {
    const double short_of = kShortOf * tolerance;
    const bool along = keeps_creases(h) && keeps_heights(h, tolerance);
    if (!along && (squared_length(h) > short_of * short_of || !is_step_along(h))) return false;
    const std::int32_t b = m_.mesh.to(h);
    int now = 0, then = 0;
    std::int32_t spoke = h;
    do {
        now += turned_over(spoke / 3);
        const std::int32_t x = m_.mesh.to(spoke), y = m_.mesh.apex(spoke);
        then += x != b && y != b && turned_over(m_.label_at(spoke), at(b), at(x), at(y));
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return then < now;
}

// What is turned over already may stay so: a torn corner's triangles have no sides.
bool CreaseTests::may_drop(std::int32_t h) const {
    const std::int32_t a = m_.mesh.from(h), b = m_.mesh.to(h);
    std::int32_t spoke = h;
    do {
        const std::int32_t x = m_.mesh.to(spoke), y = m_.mesh.apex(spoke);
        const auto fine = [&](std::int32_t v) {
            return faces_outside(m_.label_at(spoke), at(v), at(x), at(y), 0, kFacing);
        };
        if (x != b && y != b && fine(a) && !fine(b)) return false;
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return true;
}

bool CreaseTests::should_flip(std::int32_t h, double tolerance) const {
    if (m_.crease(h)) return false;
    const std::int32_t g = m_.mesh.twin(h);
    const Label label = m_.label_at(h);
    const std::int32_t a = m_.mesh.from(h), b = m_.mesh.to(h), c = m_.mesh.apex(h), d = m_.mesh.apex(g);
    const Vec3 ca = at(a) - at(c), cb = at(b) - at(c), da = at(a) - at(d), db = at(b) - at(d);
    const double sine_c = norm(cross(ca, cb)), sine_d = norm(cross(da, db));
    const double opposite = dot(ca, cb) * sine_d + dot(da, db) * sine_c;
    const bool rounder = opposite < -1e-9 * (norm(ca) * norm(cb)) * (norm(da) * norm(db));
    const bool now_low = height(label, a, b) <= tolerance, then_low = height(label, c, d) <= tolerance;
    const bool lower = then_low && !now_low;
    if (!lower && !(rounder && then_low == now_low)) return false;
    const double thinnest = lower ? kThinnest : 0;
    if (!faces_outside(label, at(c), at(d), at(b), thinnest, kFacing) ||
        !faces_outside(label, at(d), at(c), at(a), thinnest, kFacing))
        return false;
    return may_turn(h);
}

int CreaseTests::others_turned_over(std::int32_t h, const Vec3& p) const {
    int count = 0;
    for (std::int32_t spoke = m_.mesh.twin(SurfaceMesh::previous(h)); spoke != h;
         spoke = m_.mesh.twin(SurfaceMesh::previous(spoke)))
        count += turned_over(m_.label_at(spoke), p, at(m_.mesh.to(spoke)), at(m_.mesh.apex(spoke)));
    return count;
}

bool CreaseTests::opposed(std::int32_t h, const Vec3& normal) const {
    std::int32_t spoke = h;
    do {
        if (dot(surface_.normal(m_.label_at(spoke), at(m_.mesh.from(h))), normal) < -kFacing) return true;
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return false;
}

bool CreaseTests::is_step(std::int32_t h) const {
    const std::int32_t apex = SurfaceMesh::previous(h);
    return !opposed(apex, surface_.normal(m_.label_at(m_.mesh.twin(h)), at(m_.mesh.from(apex))));
}

bool CreaseTests::is_step_along(std::int32_t h) const {
    std::int32_t spoke = h;
    do {
        if (opposed(m_.mesh.twin(h), surface_.normal(m_.label_at(spoke), at(m_.mesh.to(h))))) return false;
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return true;
}

bool CreaseTests::may_turn(std::int32_t h) const {
    const std::int32_t g = m_.mesh.twin(h), c = m_.mesh.apex(h), d = m_.mesh.apex(g);
    return c != d && m_.mesh.valence(h) > 3 && m_.mesh.valence(g) > 3 &&
           !m_.mesh.joined(SurfaceMesh::previous(h), d);
}

bool CreaseTests::flip_mends(std::int32_t h, double tolerance) const {
    const std::int32_t g = m_.mesh.twin(h);
    const std::int32_t a = m_.mesh.from(h), b = m_.mesh.to(h), c = m_.mesh.apex(h), d = m_.mesh.apex(g);
    const Label label = m_.label_at(h);
    if (m_.crease(h) || height(label, c, d) > tolerance) return false;
    const int now = turned_over(h / 3) + turned_over(g / 3);
    const int then = turned_over(label, at(c), at(d), at(b)) + turned_over(label, at(d), at(c), at(a));
    return then < now && may_turn(h);
}

}  // namespace pfgeom
