// Adapts a mesh to a tolerance by local operations: merges edges where that keeps it, splits those that leave
// it, turns the others towards Delaunay's; then asks the field in the middle of every face, and splits on.
// What edge_tests.h tells takes no evaluation, and a new vertex starts from a guess good to fourth order.
//
// Source: H. Hoppe, T. DeRose, T. Duchamp, J. McDonald, W. Stuetzle, "Mesh optimization", SIGGRAPH 1993 (the
// three operations). Departures: edges are measured by the height of their arcs, so triangles are long where
// the surface is straight; vertices never move; operations are greedy, in the order of the half-edges, with
// no energy; the new vertices of a round are evaluated in parallel.
#include "pfgeom/polygonize/adapt.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/base/sort_unique.h"
#include "pfgeom/polygonize/edge_tests.h"
#include "pfgeom/polygonize/project.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace pfgeom {
namespace {

constexpr std::size_t kChunk = 64;  // new vertices a job
constexpr int kRounds = 40;         // of splits; each splits the worst edge of every triangle
constexpr int kChecks = 5;          // of faces against the field; on scans the third finds hardly any
constexpr int kFlips = 8;  // at most as many times the edges of a round: rounding could make it endless

class Adapter {
  public:
    Adapter(const CubeField& field, const AdaptOptions& options, SurfaceMesh& mesh, const Task& task)
        : field_(field), options_(options), mesh_(mesh), tests_(mesh), task_(task) {}

    void run() {
        for (const double share : {0.25, 0.5, 1.0}) {  // short edges first: that leaves better shapes
            task_.report(0.6 + 0.1 * share, "triangles");
            merge_and_flip(share * options_.edge_tolerance);
        }
        split_high_edges();
        // The splits have made edges across the bends short enough that those along them can be merged.
        merge_and_flip(options_.edge_tolerance);
        split_high_edges();
        task_.report(0.8, "triangles");
        check_faces();
    }

  private:
    // Can the edge be split?
    bool open(std::int32_t h) const {
        return !stuck_[h] && tests_.squared_length(h) >= options_.shortest_edge * options_.shortest_edge;
    }
    double open_height(std::int32_t h) const { return open(h) ? tests_.height(h) : 0; }
    void touch(std::int32_t h) {
        touched_.push_back(h);
        changed_.push_back(h / 3);
        stuck_[h] = stuck_[mesh_.twin(h)] = 0;
    }
    void touch_all() {
        touched_.clear();
        stuck_.assign(mesh_.half_edges(), 0);
        for (std::int32_t h = 0; h < mesh_.half_edges(); ++h)
            if (h < mesh_.twin(h)) touched_.push_back(h);
    }
    void merge_and_flip(double limit);
    void merge_edges(double limit);
    void split_high_edges();
    void check_faces();
    std::vector<std::int32_t> high_edges();
    std::vector<std::int32_t> edges_of_far_faces(const std::vector<std::int32_t>& faces) const;
    bool too_far(std::int32_t face) const;
    void split_edges(const std::vector<std::int32_t>& chosen);
    bool worst_of_face(std::int32_t h, double own) const;
    bool middle(std::int32_t h, SurfacePoint& p) const;
    bool split(std::int32_t h, const SurfacePoint& point);
    void flip_edges();

    const CubeField& field_;
    const AdaptOptions& options_;
    SurfaceMesh& mesh_;
    EdgeTests tests_;
    const Task& task_;
    std::vector<std::int32_t> touched_;  // half-edges to be looked at, some of them more than once
    std::vector<std::int32_t> changed_;  // faces, some of them more than once
    std::vector<char> stuck_;            // by half-edge: no vertex could be put on the zero set there
};

void Adapter::merge_and_flip(double limit) {
    merge_edges(limit);
    mesh_.compact();
    touch_all();
    flip_edges();
}

void Adapter::merge_edges(double limit) {
    const std::int32_t n = mesh_.half_edges();
    for (std::int32_t h = 0; h < n; ++h) {
        if (h % 1024 == 0) task_.check();
        if (mesh_.alive(h / 3) && tests_.may_merge(h, limit)) mesh_.collapse(h);
    }
}

// Is the half-edge's arc the highest in its triangle?
bool Adapter::worst_of_face(std::int32_t h, double own) const {
    for (const std::int32_t other : {SurfaceMesh::next(h), SurfaceMesh::previous(h)}) {
        const double theirs = open_height(other);
        if (theirs > own ||
            (theirs == own && std::min(other, mesh_.twin(other)) < std::min(h, mesh_.twin(h))))
            return false;
    }
    return true;
}

// The arc's middle: that of the cubic with the vertices' tangents, moved onto the zero set.
bool Adapter::middle(std::int32_t h, SurfacePoint& p) const {
    const std::int32_t a = mesh_.from(h), b = mesh_.to(h);
    const Vec3 d = mesh_.position[b] - mesh_.position[a];
    const Vec3 na = mesh_.normal[a], nb = mesh_.normal[b];
    const Vec3 start =
        (mesh_.position[a] + mesh_.position[b]) * 0.5 + (nb * dot(d, nb) - na * dot(d, na)) * 0.125;
    return project(field_, start, norm(d) / 2, options_.accuracy, p) && dot(p.normal, na + nb) > 0;
}

void Adapter::split_high_edges() {
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<std::int32_t> chosen = high_edges();
        if (chosen.empty()) return;
        split_edges(chosen);
        flip_edges();
    }
}

// The edges above the tolerance that are the worst of both their triangles. The others wait among the
// touched.
std::vector<std::int32_t> Adapter::high_edges() {
    std::vector<std::int32_t> chosen, waiting;
    for (std::size_t i = 0; i < touched_.size(); ++i) {
        if (i % 1024 == 0) task_.check();
        const std::int32_t h = touched_[i];
        const double own = open_height(h);
        if (own <= options_.edge_tolerance) continue;
        const bool worst = worst_of_face(h, own) && worst_of_face(mesh_.twin(h), own);
        (worst ? chosen : waiting).push_back(std::min(h, mesh_.twin(h)));
    }
    sort_unique(chosen);
    touched_ = std::move(waiting);
    return chosen;
}

void Adapter::check_faces() {
    std::vector<std::int32_t> faces(mesh_.face_count());
    std::iota(faces.begin(), faces.end(), 0);
    for (int round = 0; round < kChecks && !faces.empty(); ++round) {
        changed_.clear();
        split_edges(edges_of_far_faces(faces));
        flip_edges();
        split_high_edges();
        sort_unique(changed_);
        faces = changed_;
    }
}

// The longest edges of the faces whose middle is too far from the zero set: what the vertices' normals did
// not tell. One edge at most of each triangle, so that splits do not meet.
std::vector<std::int32_t> Adapter::edges_of_far_faces(const std::vector<std::int32_t>& faces) const {
    std::vector<char> far(faces.size());
    parallel_chunks(faces.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) far[i] = too_far(faces[i]);
    });
    std::vector<char> taken(mesh_.face_count());
    std::vector<std::int32_t> chosen;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (!far[i]) continue;
        std::int32_t longest = 3 * faces[i];
        for (const std::int32_t h : {longest + 1, longest + 2})
            if (tests_.squared_length(h) > tests_.squared_length(longest)) longest = h;
        char &mine = taken[longest / 3], &other = taken[mesh_.twin(longest) / 3];
        if (mine || other || !open(longest)) continue;
        mine = other = 1;
        chosen.push_back(longest);
    }
    return chosen;
}

bool Adapter::too_far(std::int32_t face) const {
    const Triangle& f = mesh_.faces()[face];
    Vec3 gradient;
    const Vec3 centre = (mesh_.position[f[0]] + mesh_.position[f[1]] + mesh_.position[f[2]]) / 3;
    const double value = field_.value_and_gradient(centre, gradient);
    const double limit = options_.face_tolerance;
    return value * value > limit * limit * squared_norm(gradient);
}

void Adapter::split_edges(const std::vector<std::int32_t>& chosen) {
    std::vector<SurfacePoint> points(chosen.size());
    std::vector<char> found(chosen.size());
    parallel_chunks(chosen.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) found[i] = middle(chosen[i], points[i]);
    });
    if (mesh_.face_count() + 2 * chosen.size() > options_.max_faces)
        throw LimitExceeded("polygonize: more than max_faces = " + std::to_string(options_.max_faces) +
                            " faces");
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (!found[i] || !split(chosen[i], points[i])) stuck_[chosen[i]] = stuck_[mesh_.twin(chosen[i])] = 1;
    }
}

// False, and nothing done, where a triangle would turn over. (Asking for the 70 degrees of merges and flips
// here leaves the tip of a claw of igl-armadillo 33 tolerances blunt.)
bool Adapter::split(std::int32_t h, const SurfacePoint& point) {
    const auto vertex = static_cast<std::int32_t>(mesh_.position.size());
    mesh_.position.push_back(point.position);
    mesh_.normal.push_back(point.normal);
    for (const std::int32_t e : {h, mesh_.twin(h)}) {
        if (tests_.faces_outside(mesh_.from(e), vertex, mesh_.apex(e), 0, 0) &&
            tests_.faces_outside(vertex, mesh_.to(e), mesh_.apex(e), 0, 0))
            continue;
        mesh_.position.pop_back();
        mesh_.normal.pop_back();
        return false;
    }
    mesh_.split(h, vertex);
    stuck_.resize(mesh_.half_edges(), 0);
    std::int32_t spoke = SurfaceMesh::next(h);  // from the vertex
    for (int i = 0; i < 4; ++i) {
        touch(spoke);
        touch(SurfaceMesh::next(spoke));
        spoke = mesh_.twin(SurfaceMesh::previous(spoke));
    }
    return true;
}

// Turns edges until none would be better the other way.
void Adapter::flip_edges() {
    std::vector<std::int32_t> stack = touched_;
    std::size_t left = kFlips * touched_.size();
    for (std::size_t steps = 0; !stack.empty() && left > 0; ++steps) {
        if (steps % 1024 == 0) task_.check();
        const std::int32_t h = stack.back();
        stack.pop_back();
        if (!tests_.should_flip(h, options_.edge_tolerance)) continue;
        --left;
        mesh_.flip(h);
        const std::int32_t g = mesh_.twin(h);
        touch(h);
        for (const std::int32_t outer : {SurfaceMesh::next(h), SurfaceMesh::previous(h), SurfaceMesh::next(g),
                                         SurfaceMesh::previous(g)}) {
            touch(outer);
            stack.push_back(outer);
        }
    }
}

}  // namespace

void adapt(const CubeField& field, const AdaptOptions& options, SurfaceMesh& mesh, const Task& task) {
    Adapter(field, options, mesh, task).run();
}

}  // namespace pfgeom
