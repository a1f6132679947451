#include "pfgeom/polygonize/unfold.h"

#include <algorithm>
#include <vector>

namespace pfgeom {
namespace {

constexpr int kRounds = 8;
constexpr double kFold = -0.9;  // cosine of the angle between the normals of its faces, at most
// Of both ends of an edge that may be collapsed: looking at more takes the square of the time.
constexpr int kMostNeighbours = 100;

class Unfolder {
  public:
    Unfolder(double longest, SurfaceMesh& mesh, const Task& task)
        : square_(longest * longest), mesh_(mesh), task_(task) {}

    bool run() {
        bool any = false;
        for (std::int32_t h = 0; h < mesh_.half_edges(); ++h) {
            if (h % 1024 == 0) task_.check();
            if (!mesh_.alive(h / 3) || h > mesh_.twin(h) || cosine(h / 3, mesh_.twin(h) / 3) > kFold)
                continue;
            const std::int32_t e = best_beside(h);
            any |= e >= 0 && mesh_.collapse(e);
        }
        return any;
    }

  private:
    const Vec3& at(std::int32_t v) const { return mesh_.position[v == moved_ ? to_ : v]; }
    Vec3 normal(std::int32_t face) const {
        const auto& [a, b, c] = mesh_.faces()[face];
        return cross(at(b) - at(a), at(c) - at(a));
    }
    // -1 for a face that has none: a fold of its own.
    double cosine(std::int32_t one, std::int32_t other) const {
        const Vec3 n = normal(one), m = normal(other);
        const double size = norm(n) * norm(m);
        return size > 0 ? dot(n, m) / size : -1;
    }
    std::int32_t best_beside(std::int32_t h);
    std::vector<std::int32_t> faces_around(std::int32_t h) const;
    double bend(const std::vector<std::int32_t>& faces) const;
    std::int32_t across(std::int32_t h) const;
    bool dies(std::int32_t face) const {
        const Triangle& t = mesh_.faces()[face];
        return moved_ >= 0 && std::ranges::count(t, moved_) > 0 && std::ranges::count(t, to_) > 0;
    }

    double square_;
    SurfaceMesh& mesh_;
    const Task& task_;
    std::int32_t moved_ = -1, to_ = -1;  // a collapse that is thought of
};

// Of the edges of a fold's two faces, both ways, the one whose collapse takes away most; -1: none does.
std::int32_t Unfolder::best_beside(std::int32_t h) {
    const std::int32_t g = mesh_.twin(h);
    double most = 0;
    std::int32_t best = -1;
    for (const std::int32_t edge : {h, SurfaceMesh::next(h), SurfaceMesh::previous(h), SurfaceMesh::next(g),
                                    SurfaceMesh::previous(g)}) {
        if (squared_norm(at(mesh_.from(edge)) - at(mesh_.to(edge))) > square_ ||
            mesh_.valence(edge) + mesh_.valence(mesh_.twin(edge)) > kMostNeighbours)
            continue;
        const std::vector<std::int32_t> faces = faces_around(edge);
        const double before = bend(faces);
        for (const std::int32_t e : {edge, mesh_.twin(edge)}) {
            moved_ = mesh_.from(e), to_ = mesh_.to(e);
            const double less = before - bend(faces);
            moved_ = to_ = -1;
            if (less > most) most = less, best = e;
        }
    }
    return best;
}

// Around both ends, each once.
std::vector<std::int32_t> Unfolder::faces_around(std::int32_t h) const {
    std::vector<std::int32_t> faces;
    for (const std::int32_t start : {h, mesh_.twin(h)})
        mesh_.for_each_spoke(start, [&](std::int32_t spoke) {
            if (std::ranges::count(faces, spoke / 3) == 0) faces.push_back(spoke / 3);
        });
    return faces;
}

// Of the faces' edges: length times 1 - cosine of the turn.
double Unfolder::bend(const std::vector<std::int32_t>& faces) const {
    double sum = 0;
    for (const std::int32_t f : faces) {
        if (dies(f)) continue;
        for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
            const std::int32_t g = across(h);
            if (g < h && std::ranges::count(faces, g / 3) > 0) continue;  // seen from there
            sum += norm(at(mesh_.from(h)) - at(mesh_.to(h))) * (1 - cosine(f, g / 3));
        }
    }
    return sum;
}

// The half-edge on the other side, or beyond the face there if that dies.
std::int32_t Unfolder::across(std::int32_t h) const {
    const std::int32_t g = mesh_.twin(h);
    if (!dies(g / 3)) return g;
    const std::int32_t next = SurfaceMesh::next(g), v = mesh_.from(next), w = mesh_.to(next);
    const bool goes = (v == moved_ && w == to_) || (v == to_ && w == moved_);
    return mesh_.twin(goes ? SurfaceMesh::previous(g) : next);
}

}  // namespace

void unfold(double longest, LabelledMesh& mesh, const Task& task) {
    bool any = true;
    for (int round = 0; round < kRounds && any; ++round) {
        any = Unfolder(longest, mesh.mesh, task).run();
        mesh.compact();
    }
}

}  // namespace pfgeom
