// Adapts a mesh to a tolerance by local operations. With unit normals n, n' at the ends of an edge and d from one
// to the other, the arc over the edge has the height |(n' - n)·d| / 8 up to third order: no evaluation is needed
// to find edges that are too long or too short, and the first guess for a new vertex is good to fourth order.
// Source: H. Hoppe, T. DeRose, T. Duchamp, J. McDonald, W. Stuetzle, "Mesh optimization", SIGGRAPH 1993 (the three
// operations). Departures: lengths are measured by the height of the arc, so triangles are long where the surface
// is straight; vertices never move.
#include "pfgeom/polygonize/adapt.h"

#include <algorithm>
#include <string>

#include "pfgeom/base/parallel.h"
#include "pfgeom/polygonize/project.h"

namespace pfgeom {
namespace {

constexpr std::size_t kChunk = 64;  // new vertices a job
constexpr int kRounds = 40;         // of splits; each splits the worst edge of every triangle
constexpr int kFlips = 8;           // at most as many times the edges in a round: rounding could make it endless
constexpr double kFacing = 0.3;     // least cosine between a triangle and the normals at its corners
constexpr double kThinnest = 0.15;  // height over longest side of the triangles that a merge may make
constexpr int kMostNeighbours = 10; // of a vertex after a merge

class Adapter {
  public:
    Adapter(const CubeField& field, const AdaptOptions& options, SurfaceMesh& mesh, const Task& task)
        : field_(field), options_(options), mesh_(mesh), task_(task) {}

    void run() {
        for (const double share : {0.25, 0.5, 1.0}) {
            merge_edges(share * options_.tolerance);
            mesh_.compact();
            touch_all();
            flip_edges();
        }
        touch_all();
        for (int round = 0; round < kRounds && split_edges(); ++round) flip_edges();
    }

  private:
    double height(std::int32_t a, std::int32_t b) const {
        return std::abs(dot(mesh_.normal[b] - mesh_.normal[a], mesh_.position[b] - mesh_.position[a])) / 8;
    }
    double height(std::int32_t h) const { return height(mesh_.from(h), mesh_.to(h)); }
    // The height, if the edge can be split.
    double open_height(std::int32_t h) const {
        const Vec3 d = mesh_.position[mesh_.to(h)] - mesh_.position[mesh_.from(h)];
        return stuck_[h] || squared_norm(d) < options_.shortest_edge * options_.shortest_edge ? 0 : height(h);
    }
    void touch(std::int32_t h) {
        touched_.push_back(h);
        stuck_[h] = stuck_[mesh_.twin(h)] = 0;
    }
    void touch_all() {
        touched_.clear();
        stuck_.assign(mesh_.half_edges(), 0);
        for (std::int32_t h = 0; h < mesh_.half_edges(); ++h)
            if (h < mesh_.twin(h)) touched_.push_back(h);
    }
    bool faces_outside(std::int32_t a, std::int32_t b, std::int32_t c, double thinnest) const;
    void merge_edges(double limit);
    bool may_merge(std::int32_t h, double limit) const;
    bool split_edges();
    bool worst_of_face(std::int32_t h, double height) const;
    bool middle(std::int32_t h, SurfacePoint& p) const;
    void split(std::int32_t h, const SurfacePoint& point);
    void flip_edges();
    bool should_flip(std::int32_t h) const;

    const CubeField& field_;
    const AdaptOptions& options_;
    SurfaceMesh& mesh_;
    const Task& task_;
    std::vector<std::int32_t> touched_;  // half-edges to be looked at, some of them more than once
    std::vector<char> stuck_;            // by half-edge: no vertex could be put on the zero set there
};

// Is the triangle counter-clockwise with respect to its vertices' normals, and not too thin?
bool Adapter::faces_outside(std::int32_t a, std::int32_t b, std::int32_t c, double thinnest) const {
    const Vec3 ab = mesh_.position[b] - mesh_.position[a], ac = mesh_.position[c] - mesh_.position[a];
    const Vec3 n = cross(ab, ac);
    const double area = norm(n);
    const double side = std::max({squared_norm(ab), squared_norm(ac), squared_norm(ac - ab)});
    if (!(area > thinnest * side)) return false;
    for (const std::int32_t v : {a, b, c})
        if (dot(n, mesh_.normal[v]) < kFacing * area) return false;
    return true;
}

// Merging from(h) into to(h): no edge may leave the limit, no triangle turn over or become a sliver.
bool Adapter::may_merge(std::int32_t h, double limit) const {
    const std::int32_t b = mesh_.to(h);
    if (height(h) > limit) return false;
    int neighbours = mesh_.valence(mesh_.twin(h)) - 4;
    std::int32_t spoke = h;
    do {
        ++neighbours;
        const std::int32_t x = mesh_.to(spoke), y = mesh_.apex(spoke);
        if (x != b && height(b, x) > limit) return false;
        if (x != b && y != b && !faces_outside(b, x, y, kThinnest)) return false;
        spoke = mesh_.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return neighbours <= kMostNeighbours;
}

void Adapter::merge_edges(double limit) {
    const std::int32_t n = mesh_.half_edges();
    for (std::int32_t h = 0; h < n; ++h) {
        if (h % 1024 == 0) task_.check();
        if (mesh_.alive(h / 3) && may_merge(h, limit)) mesh_.collapse(h);
    }
}

// Is the half-edge's arc the highest in its triangle?
bool Adapter::worst_of_face(std::int32_t h, double own) const {
    for (const std::int32_t other : {SurfaceMesh::next(h), SurfaceMesh::previous(h)}) {
        const double theirs = open_height(other);
        if (theirs > own || (theirs == own && std::min(other, mesh_.twin(other)) < std::min(h, mesh_.twin(h))))
            return false;
    }
    return true;
}

// The arc's middle: that of the cubic with the vertices' tangents, moved onto the zero set.
bool Adapter::middle(std::int32_t h, SurfacePoint& p) const {
    const std::int32_t a = mesh_.from(h), b = mesh_.to(h);
    const Vec3 d = mesh_.position[b] - mesh_.position[a];
    const Vec3 na = mesh_.normal[a], nb = mesh_.normal[b];
    const Vec3 start = (mesh_.position[a] + mesh_.position[b]) * 0.5 + (nb * dot(d, nb) - na * dot(d, na)) * 0.125;
    return project(field_, start, norm(d) / 4, options_.accuracy, p) && dot(p.normal, na + nb) > 0;
}

// Splits the edges that are the worst of both their triangles; false once there are none.
bool Adapter::split_edges() {
    std::vector<std::int32_t> chosen, waiting;
    for (std::size_t i = 0; i < touched_.size(); ++i) {
        if (i % 1024 == 0) task_.check();
        const std::int32_t h = touched_[i];
        const double own = open_height(h);
        if (own <= options_.tolerance) continue;
        const bool worst = worst_of_face(h, own) && worst_of_face(mesh_.twin(h), own);
        (worst ? chosen : waiting).push_back(std::min(h, mesh_.twin(h)));
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<SurfacePoint> points(chosen.size());
    std::vector<char> found(chosen.size());
    parallel_chunks(chosen.size(), kChunk, task_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) found[i] = middle(chosen[i], points[i]);
    });
    if (mesh_.face_count() + 2 * chosen.size() > options_.max_faces)
        throw LimitExceeded("polygonize: more than max_faces = " + std::to_string(options_.max_faces) + " faces");
    touched_ = std::move(waiting);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (found[i])
            split(chosen[i], points[i]);
        else
            stuck_[chosen[i]] = stuck_[mesh_.twin(chosen[i])] = 1;
    }
    return !chosen.empty();
}

void Adapter::split(std::int32_t h, const SurfacePoint& point) {
    const auto vertex = static_cast<std::int32_t>(mesh_.position.size());
    mesh_.position.push_back(point.position);
    mesh_.normal.push_back(point.normal);
    mesh_.split(h, vertex);
    stuck_.resize(mesh_.half_edges(), 0);
    std::int32_t spoke = SurfaceMesh::next(h);  // from the vertex
    for (int i = 0; i < 4; ++i) {
        touch(spoke);
        touch(SurfaceMesh::next(spoke));
        spoke = mesh_.twin(SurfaceMesh::previous(spoke));
    }
}

// Turns edges until none would be better the other way.
void Adapter::flip_edges() {
    std::vector<std::int32_t> stack = touched_;
    std::size_t left = kFlips * touched_.size();
    for (std::size_t steps = 0; !stack.empty() && left > 0; ++steps) {
        if (steps % 1024 == 0) task_.check();
        const std::int32_t h = stack.back();
        stack.pop_back();
        if (!should_flip(h)) continue;
        --left;
        mesh_.flip(h);
        const std::int32_t g = mesh_.twin(h);
        touch(h);
        for (const std::int32_t outer : {SurfaceMesh::next(h), SurfaceMesh::previous(h), SurfaceMesh::next(g), SurfaceMesh::previous(g)}) {
            touch(outer);
            stack.push_back(outer);
        }
    }
}

// Better means: a lower arc where it is above the tolerance, else Delaunay (the opposite angles' sum above 180°).
bool Adapter::should_flip(std::int32_t h) const {
    const std::int32_t g = mesh_.twin(h);
    const std::int32_t a = mesh_.from(h), b = mesh_.to(h), c = mesh_.apex(h), d = mesh_.apex(g);
    const double now = height(a, b), then = height(c, d);
    const auto &p = mesh_.position;
    const Vec3 ca = p[a] - p[c], cb = p[b] - p[c], da = p[a] - p[d], db = p[b] - p[d];
    const double sine_c = norm(cross(ca, cb)), sine_d = norm(cross(da, db));
    const double opposite = dot(ca, cb) * sine_d + dot(da, db) * sine_c;
    const bool rounder = opposite < -1e-9 * (norm(ca) * norm(cb)) * (norm(da) * norm(db));
    const bool now_low = now <= options_.tolerance, then_low = then <= options_.tolerance;
    const bool lower = then_low && !now_low;
    if (!lower && !(rounder && then_low == now_low)) return false;
    const double thinnest = lower ? kThinnest : 0;
    if (!faces_outside(c, d, b, thinnest) || !faces_outside(d, c, a, thinnest)) return false;
    return c != d && mesh_.valence(h) > 3 && mesh_.valence(g) > 3 && !mesh_.joined(SurfaceMesh::previous(h), d);
}

}  // namespace

void adapt(const CubeField& field, const AdaptOptions& options, SurfaceMesh& mesh, const Task& task) {
    Adapter(field, options, mesh, task).run();
}

}  // namespace pfgeom
