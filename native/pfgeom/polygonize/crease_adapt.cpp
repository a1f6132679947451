// As adapt.cpp, for faces that know their quadrics: what is asked there of the field is asked here of the one
// quadric of a face, or of the two at a crease.
#include "pfgeom/polygonize/crease_adapt.h"

#include "pfgeom/base/error.h"
#include "pfgeom/polygonize/crease_mend.h"
#include "pfgeom/polygonize/crease_tests.h"

#include <algorithm>
#include <string>

namespace pfgeom {
namespace {

constexpr double kReach = 8;  // how far a vertex may be moved, in tolerances
// The same where no triangle turns over: the bottom of a valley and the tip of a pit between ellipsoids lie
// so far beyond what cutting cells found of them.
constexpr double kFarReach = 64;
constexpr double kShort = 0.1;  // edges that may be dropped across creases, in tolerances
constexpr int kRounds = 40;     // of splits
constexpr int kFlips = 8;       // at most as many times the edges: rounding could make it endless

class Adapter {
  public:
    Adapter(const LabelSurface& surface, const AdaptOptions& options, LabelledMesh& mesh, const Task& task)
        : surface_(surface), options_(options), m_(mesh), tests_(mesh, surface), task_(task) {}

    void run() {
        place_vertices();
        drop_short_edges();
        place_vertices();                              // what has been dropped was on other creases
        for (const double share : {0.25, 0.5, 1.0}) {  // short edges first: that leaves better shapes
            task_.report(0.6 + 0.1 * share, "triangles");
            merge_edges(share * options_.edge_tolerance);
            flip_edges();
        }
        split_edges();
        merge_edges(options_.edge_tolerance);
        flip_edges();
        split_edges();
        mend_creases(surface_, options_, m_, task_);
    }

  private:
    void place_vertices();
    bool place_exactly(std::int32_t h, std::span<const Label> labels);
    bool faces_outside_at(std::int32_t h, const Vec3& p) const;
    void drop_short_edges();
    void merge_edges(double limit);
    void merge_once(double limit);
    void flip_edges();
    void split_edges();
    double excess(std::int32_t h) const;
    bool split(std::int32_t h);
    bool split_at(std::int32_t h, const Vec3& middle);
    void place_waiting();

    const LabelSurface& surface_;
    const AdaptOptions& options_;
    LabelledMesh& m_;
    CreaseTests tests_;
    const Task& task_;
    std::vector<std::int32_t> waiting_;  // half-edges from vertices that are not yet where they belong
};

void Adapter::place_vertices() {
    std::vector<char> placed(m_.mesh.position.size());
    for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h) {
        if (h % 1024 == 0) task_.check();
        const std::int32_t v = m_.mesh.from(h);
        if (placed[v]) continue;
        placed[v] = 1;
        const std::vector<Label> labels = m_.labels_around(h);
        if (labels.size() > 1 && place_exactly(h, labels)) continue;
        surface_.project(labels, kReach * options_.face_tolerance, options_.accuracy, m_.mesh.position[v]);
    }
}

// Onto the curve or corner however flat its quadrics cross, and however far it is. False, and nothing done,
// where a triangle would turn over.
bool Adapter::place_exactly(std::int32_t h, std::span<const Label> labels) {
    Vec3& p = m_.mesh.position[m_.mesh.from(h)];
    Vec3 foot = p;
    if (!surface_.project(labels, kFarReach * options_.face_tolerance, options_.accuracy, foot,
                          LabelSurface::kLeastSineOfCreases) ||
        !faces_outside_at(h, foot))
        return false;
    p = foot;
    return true;
}

// The triangles around from(h), if it were there.
bool Adapter::faces_outside_at(std::int32_t h, const Vec3& p) const {
    std::int32_t spoke = h;
    do {
        if (!tests_.faces_outside(m_.label_at(spoke), p, m_.mesh.position[m_.mesh.to(spoke)],
                                  m_.mesh.position[m_.mesh.apex(spoke)], 0, 0))
            return false;
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return true;
}

// Corners that cuts have torn apart, and strips of a seam's width.
void Adapter::drop_short_edges() {
    const double limit = kShort * options_.face_tolerance;
    for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h) {
        if (h % 1024 == 0) task_.check();
        if (m_.mesh.alive(h / 3) && tests_.squared_length(h) <= limit * limit && tests_.may_drop(h))
            m_.mesh.collapse(h);
    }
    m_.compact();
}

// Until hardly any is left to merge: one merge makes room for others.
void Adapter::merge_edges(double limit) {
    for (std::size_t before = 0; before != m_.label.size();) {
        before = m_.label.size();
        merge_once(limit);
        if (m_.label.size() * 50 > before * 49) break;
    }
}

void Adapter::merge_once(double limit) {
    for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h) {
        if (h % 1024 == 0) task_.check();
        if (m_.mesh.alive(h / 3) && tests_.may_merge(h, limit)) m_.mesh.collapse(h);
    }
    m_.compact();
}

void Adapter::flip_edges() {
    std::vector<std::int32_t> stack;
    for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h)
        if (h < m_.mesh.twin(h)) stack.push_back(h);
    std::size_t left = kFlips * stack.size();
    for (std::size_t steps = 0; !stack.empty() && left > 0; ++steps) {
        if (steps % 1024 == 0) task_.check();
        const std::int32_t h = stack.back();
        stack.pop_back();
        if (!tests_.should_flip(h, options_.edge_tolerance)) continue;
        --left;
        m_.mesh.flip(h);
        const std::int32_t g = m_.mesh.twin(h);
        for (const std::int32_t outer :
             {SurfaceMesh::next(h), SurfaceMesh::previous(h), SurfaceMesh::next(g), SurfaceMesh::previous(g)})
            stack.push_back(outer);
    }
}

// How far an edge is above the tolerance; 0 for those that may stay.
double Adapter::excess(std::int32_t h) const {
    if (tests_.squared_length(h) < options_.shortest_edge * options_.shortest_edge) return 0;
    const double height = tests_.height(h);
    return height > options_.edge_tolerance ? height : 0;
}

// In rounds, the highest edges first.
void Adapter::split_edges() {
    waiting_.clear();
    for (int round = 0; round < kRounds; ++round) {
        std::vector<std::pair<double, std::int32_t>> high;
        for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h) {
            if (h % 1024 == 0) task_.check();
            if (h > m_.mesh.twin(h)) continue;
            const double e = excess(h);
            if (e > 0) high.emplace_back(-e, h);
        }
        if (m_.mesh.face_count() + 2 * high.size() > options_.max_faces)
            throw LimitExceeded("polygonize: more than max_faces = " + std::to_string(options_.max_faces) +
                                " faces");
        std::sort(high.begin(), high.end());
        bool any = false;
        for (const auto& [e, h] : high)
            if (excess(h) == -e) any |= split(h);
        if (!any) return;
        place_waiting();
        flip_edges();
    }
}

// Once there is room.
void Adapter::place_waiting() {
    std::erase_if(waiting_, [&](std::int32_t h) { return place_exactly(h, m_.labels_around(h)); });
}

// At the arc's middle. Where a triangle would turn over, half as far from the chord: its neighbours are
// split, too, and make room. False if that is too far as well.
bool Adapter::split(std::int32_t h) {
    const std::array<Label, 2> labels{m_.label_at(h), m_.label_at(m_.mesh.twin(h))};
    const Vec3 a = m_.mesh.position[m_.mesh.from(h)], b = m_.mesh.position[m_.mesh.to(h)];
    const Vec3 chord = (a + b) * 0.5;
    Vec3 arc = chord;
    const std::span<const Label> used(labels.data(), m_.crease(h) ? 2 : 1);
    if (!surface_.project(used, norm(b - a) / 2, options_.accuracy, arc, LabelSurface::kLeastSineOfCreases))
        return false;
    if (split_at(h, arc)) return true;
    if (!m_.crease(h) || !split_at(h, (chord + arc) * 0.5)) return false;
    waiting_.push_back(m_.mesh.half_edges() - 6);  // from the new vertex on, along the crease
    return true;
}

bool Adapter::split_at(std::int32_t h, const Vec3& middle) {
    for (const std::int32_t e : {h, m_.mesh.twin(h)}) {
        const Vec3 from = m_.mesh.position[m_.mesh.from(e)], to = m_.mesh.position[m_.mesh.to(e)];
        const Vec3 apex = m_.mesh.position[m_.mesh.apex(e)];
        if (!tests_.faces_outside(m_.label_at(e), from, middle, apex, 0, 0) ||
            !tests_.faces_outside(m_.label_at(e), middle, to, apex, 0, 0))
            return false;
    }
    m_.split(h, middle);
    return true;
}

}  // namespace

void adapt_creases(const LabelSurface& surface, const AdaptOptions& options, LabelledMesh& mesh,
                   const Task& task) {
    Adapter(surface, options, mesh, task).run();
}

}  // namespace pfgeom
