// A tree asks which of two quadrics is the surface. Where the answer changes they may be up to two tolerances
// apart, and what asks, a third quadric or a cut, is seen there as a wall: creases that the shape has not.
#include "pfgeom/polygonize/close_steps.h"

#include "pfgeom/polygonize/crease_tests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

constexpr int kRounds = 8;
constexpr double kAlike = 0.9;    // cosine of the angle between a wall's two sides, at least
constexpr double kWall = 0.94;    // ... between a wall and its sides, at most
constexpr double kFacing = 0.95;  // ... between a new triangle and the normals at its corners, at least
constexpr double kWidest = 2;     // of walls that slope, in heights of the highest step
// Of the highest step: a higher one goes to the middle or stays. It may be there in truth, and then a
// pocket's floor would come up to its rim.
constexpr double kToOneSide = 0.5;
// New vertices may make so many times the triangles, and no more: what a hostile file asks for must end.
constexpr std::int32_t kMostGrowth = 2;
// Accuracy of new vertices, in heights.
constexpr double kAccuracy = 1e-3;

class StepCloser {
  public:
    StepCloser(const LabelSurface& surface, double highest, LabelledMesh& mesh, const Task& task)
        : surface_(surface), highest_(highest), m_(mesh), tests_(mesh, surface), task_(task) {}

    void run() {
        cut_sides();
        for (int round = 0; round < kRounds; ++round) {
            const bool joined = join_sides();
            if (!peel_walls() && !joined) break;
        }
    }

  private:
    using Labels = std::vector<Label>;

    const Vec3& at(std::int32_t v) const { return m_.mesh.position[v]; }
    bool narrow(std::int32_t h) const {
        return tests_.squared_length(h) <= kWidest * kWidest * highest_ * highest_;
    }
    static bool has(const Labels& labels, Label label) {
        return std::find(labels.begin(), labels.end(), label) != labels.end();
    }
    void cut_sides();
    void cut(std::int32_t h);
    bool above_step(std::int32_t h) const;
    bool join_sides();
    double height_across(std::int32_t h) const;
    bool join(std::int32_t h);
    double facing(std::int32_t h, const Vec3& p) const;
    double facing(Label label, const std::array<Vec3, 3>& t) const;
    bool peel_walls();
    bool peel(std::int32_t h);

    static constexpr double kNoStep = -1;

    const LabelSurface& surface_;
    double highest_;
    LabelledMesh& m_;
    CreaseTests tests_;
    const Task& task_;
};

// The apex above a crease, of a wall's triangle: is it as near as a step's other side, and do the surfaces
// there but for the wall face the way of that below the crease?
bool StepCloser::above_step(std::int32_t h) const {
    if (!m_.crease(h)) return false;
    const Label wall = m_.label_at(h), below = m_.label_at(m_.mesh.twin(h));
    const std::int32_t apex = SurfaceMesh::previous(h);
    const Vec3 &a = at(m_.mesh.from(h)), &b = at(m_.mesh.to(h)), &c = at(m_.mesh.from(apex));
    const double widest = kWidest * highest_;
    const Vec3 n = surface_.normal(below, c);
    if (norm(cross(b - a, c - a)) > widest * norm(b - a) || std::abs(dot(n, c - a)) > highest_) return false;
    if (dot(n, surface_.normal(wall, c)) > kWall) return false;
    const Labels there = m_.labels_around(apex);
    return std::ranges::all_of(
        there, [&](Label label) { return label == wall || dot(n, surface_.normal(label, c)) >= kAlike; });
}

// Both sides of a wall get vertices opposite to each other.
void StepCloser::cut_sides() {
    const std::int32_t last = m_.mesh.half_edges();
    for (std::int32_t h = 0; h < last && m_.mesh.half_edges() < kMostGrowth * last; ++h) {
        if (h % 1024 == 0) task_.check();
        if (above_step(h)) cut(h);
    }
}

void StepCloser::cut(std::int32_t h) {
    const Vec3 a = at(m_.mesh.from(h)), b = at(m_.mesh.to(h)), c = at(m_.mesh.apex(h));
    const double along = dot(c - a, b - a) / squared_norm(b - a);
    if (!(along > 0 && along < 1)) return;
    Vec3 foot = a + along * (b - a);
    const double width = norm(c - foot);
    if (std::min(norm(foot - a), norm(foot - b)) <= width) return;
    const std::array<Label, 2> sides{m_.label_at(h), m_.label_at(m_.mesh.twin(h))};
    if (surface_.project(sides, width, kAccuracy * highest_, foot, LabelSurface::kLeastSineOfCreases))
        m_.split(h, foot);
}

// Of an edge across a wall, from its one side to the other: how far they are apart. The labels that its ends
// do not share are those of the sides.
double StepCloser::height_across(std::int32_t h) const {
    if (!narrow(h)) return kNoStep;
    const std::int32_t g = m_.mesh.twin(h);
    const Labels here = m_.labels_around(h), there = m_.labels_around(g);
    const Vec3 &a = at(m_.mesh.from(h)), &b = at(m_.mesh.to(h));
    double height = kNoStep;
    bool wall = false;
    for (const Label one : here) {
        if (has(there, one)) continue;
        const Vec3 n = surface_.normal(one, a);
        for (const Label other : there) {
            if (has(here, other)) continue;
            if (dot(n, surface_.normal(other, b)) < kAlike) return kNoStep;
            height = std::max(height, std::abs(dot(n, b - a)));
        }
        for (const Label side : {m_.label_at(h), m_.label_at(g)})
            wall |= has(there, side) && dot(n, surface_.normal(side, a)) <= kWall;
    }
    return wall && height <= highest_ ? height : kNoStep;
}

// The shortest edges first: those between vertices opposite to each other.
bool StepCloser::join_sides() {
    std::vector<std::pair<double, std::int32_t>> edges;
    for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h) {
        if (h % 1024 == 0) task_.check();
        if (h < m_.mesh.twin(h) && height_across(h) >= 0) edges.emplace_back(tests_.squared_length(h), h);
    }
    std::sort(edges.begin(), edges.end());
    bool any = false;
    for (const auto& [length, h] : edges) {
        task_.check();
        any |= m_.mesh.alive(h / 3) && join(h);
    }
    m_.compact();
    return any;
}

bool StepCloser::join(std::int32_t h) {
    const double height = height_across(h);
    if (height < 0) return false;
    const std::int32_t g = m_.mesh.twin(h), b = m_.mesh.to(h);
    const Vec3 here = at(m_.mesh.from(h)), there = at(b), middle = (here + there) / 2;
    if (facing(h, middle) >= kFacing && facing(g, middle) >= kFacing && m_.mesh.collapse(h)) {
        m_.mesh.position[b] = middle;
        return true;
    }
    if (height > kToOneSide * highest_) return false;
    std::pair first{facing(h, there), h}, second{facing(g, here), g};
    if (second.first > first.first) std::swap(first, second);
    for (const auto& [cosine, e] : {first, second}) {
        if (cosine >= kFacing && m_.mesh.collapse(e)) return true;
    }
    return false;
}

// The least cosine between the triangles around from(h), were it at p, and what they show, but for those that
// vanish with h and those of walls, which may become flat, but not turn over.
double StepCloser::facing(std::int32_t h, const Vec3& p) const {
    const std::int32_t a = m_.mesh.from(h), b = m_.mesh.to(h);
    const Labels there = m_.labels_around(m_.mesh.twin(h));
    double least = 1;
    m_.mesh.for_each_spoke(h, [&](std::int32_t spoke) {
        const std::int32_t v = m_.mesh.to(spoke), w = m_.mesh.apex(spoke);
        if (v == b || w == b) return;
        const Label label = m_.label_at(spoke);
        if (!has(there, label))
            least = std::min(least, facing(label, {p, at(v), at(w)}));
        else if (dot(cross(at(v) - at(a), at(w) - at(a)), cross(at(v) - p, at(w) - p)) < 0)
            least = -1;
    });
    return least;
}

double StepCloser::facing(Label label, const std::array<Vec3, 3>& t) const {
    const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
    double least = 1;
    for (const Vec3& p : t) least = std::min(least, dot(n, surface_.normal(label, p)));
    return least;
}

bool StepCloser::peel_walls() {
    bool any = false;
    for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h) {
        if (h % 1024 == 0) task_.check();
        any |= above_step(h) && peel(h);
    }
    return any;
}

//        c              What is left of a wall above the crease a-b, between joined vertices, becomes part of
//      /   .            the side below.
//    a ----- b
//      .   /
//        d
bool StepCloser::peel(std::int32_t h) {
    const std::int32_t g = m_.mesh.twin(h);
    const Vec3 &a = at(m_.mesh.from(h)), &b = at(m_.mesh.to(h)), &c = at(m_.mesh.apex(h)),
               &d = at(m_.mesh.apex(g));
    const Label below = m_.label_at(g);
    if (!tests_.may_turn(h) || facing(below, {c, d, b}) < kFacing || facing(below, {d, c, a}) < kFacing)
        return false;
    m_.mesh.flip(h);
    m_.label[h / 3] = below;
    return true;
}

}  // namespace

void close_steps(const LabelSurface& surface, double highest, LabelledMesh& mesh, const Task& task) {
    StepCloser(surface, highest, mesh, task).run();
}

}  // namespace pfgeom
