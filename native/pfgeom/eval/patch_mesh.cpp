#include "pfgeom/eval/patch_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pfgeom {
namespace {

constexpr double kFlatter = 0.9;     // than the edge in whose place it comes: or turning could be endless
constexpr int kTurns = 4;            // rounds
constexpr double kLeastArea = 1e-9;  // in weights; a lattice of 64 parts has 2e-4
constexpr double kFacing = 0.5;      // least cosine between a new triangle and the surface
constexpr double kThinnest = 0.01;   // its least height over its longest side

class Thinner {
  public:
    Thinner(const CurvedTriangle& patch, double chord, PatchMesh& mesh)
        : patch_(patch), chord_(chord), m_(mesh), around_(mesh.weights.size()) {
        for (std::size_t f = 0; f < m_.faces.size(); ++f)
            for (const std::int32_t v : m_.faces[f]) around(v).push_back(static_cast<std::int32_t>(f));
    }

    void run() {
        for (bool any = true; any;) {
            turn_edges();
            any = false;
            for (std::size_t v = m_.rim; v < around_.size(); ++v) any |= drop(static_cast<std::int32_t>(v));
        }
        std::erase_if(m_.faces, [](const Triangle& t) { return t[0] < 0; });
    }

  private:
    std::vector<std::int32_t>& around(std::int32_t v) { return around_[static_cast<std::size_t>(v)]; }
    Triangle& face(std::int32_t f) { return m_.faces[static_cast<std::size_t>(f)]; }
    const Vec3& weights(std::int32_t v) const { return m_.weights[static_cast<std::size_t>(v)]; }
    const Vec3& at(std::int32_t v) const { return m_.position[static_cast<std::size_t>(v)]; }

    Vec3 normal(const Vec3& w) const {
        const auto [a, b, c] = patch_.tangent(w);
        return normalized(cross(b - a, c - a));
    }
    // Of the arc over an edge. Along the surface a chord may be off: it is another point's.
    double height(std::int32_t a, std::int32_t b) const {
        const Vec3 middle = (weights(a) + weights(b)) * 0.5;
        return std::abs(dot(patch_.bend(weights(a) - weights(b)), normal(middle))) / 4;
    }
    bool may_be(const Triangle& t) const;
    bool turn_edge(std::int32_t f, std::size_t corner);
    void turn_edges();
    bool drop(std::int32_t v);
    double highest_edge(const std::vector<Triangle>& fan, std::int32_t apex) const;
    void remove(std::int32_t f);
    void replace(std::int32_t f, const Triangle& by);

    const CurvedTriangle& patch_;
    double chord_;
    PatchMesh& m_;
    std::vector<std::vector<std::int32_t>> around_;  // faces of each vertex
};

// Positive among the weights, so that the triangles cover the patch once; no fold, no sliver in space.
bool Thinner::may_be(const Triangle& t) const {
    const Vec3 u = weights(t[1]) - weights(t[0]), v = weights(t[2]) - weights(t[0]);
    if (u.x * v.y - u.y * v.x <= kLeastArea) return false;
    const Vec3 p = at(t[1]) - at(t[0]), q = at(t[2]) - at(t[0]), n = cross(p, q);
    const double area = norm(n), side = std::max({squared_norm(p), squared_norm(q), squared_norm(p - q)});
    const Vec3 middle = (weights(t[0]) + weights(t[1]) + weights(t[2])) / 3;
    return area > kThinnest * side && dot(n, normal(middle)) > kFacing * area;
}

void Thinner::remove(std::int32_t f) {
    for (const std::int32_t v : face(f)) std::erase(around(v), f);
    face(f) = {-1, -1, -1};
}

void Thinner::replace(std::int32_t f, const Triangle& by) {
    remove(f);
    face(f) = by;
    for (const std::int32_t v : by) around(v).push_back(f);
}

// The edge from a corner to the next: if it is flatter between the two apexes.
bool Thinner::turn_edge(std::int32_t f, std::size_t corner) {
    const std::int32_t a = face(f)[corner], b = face(f)[(corner + 1) % 3], c = face(f)[(corner + 2) % 3];
    for (const std::int32_t g : around(b)) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (face(g)[k] != b || face(g)[(k + 1) % 3] != a) continue;
            const std::int32_t d = face(g)[(k + 2) % 3];
            const Triangle one{c, a, d}, other{d, b, c};
            if (height(c, d) >= kFlatter * height(a, b) || !may_be(one) || !may_be(other)) return false;
            replace(f, one);
            replace(g, other);
            return true;
        }
    }
    return false;  // on the rim
}

void Thinner::turn_edges() {
    bool any = true;
    for (int round = 0; any && round < kTurns; ++round) {
        any = false;
        for (std::size_t f = 0; f < m_.faces.size(); ++f)
            for (std::size_t k = 0; k < 3 && m_.faces[f][0] >= 0; ++k)
                any |= turn_edge(static_cast<std::int32_t>(f), k);
    }
}

// Of the new edges if the fan's outer edges were joined to one of their ends; infinite where they may not be.
double Thinner::highest_edge(const std::vector<Triangle>& fan, std::int32_t apex) const {
    double most = 0;
    for (const auto& [v, r, s] : fan) {
        if (r == apex || s == apex) continue;
        if (!may_be({apex, r, s})) return std::numeric_limits<double>::infinity();
        most = std::max({most, height(apex, r), height(apex, s)});
    }
    return most;
}

// Into the neighbour that leaves the flattest edges.
bool Thinner::drop(std::int32_t v) {
    std::vector<Triangle> fan;
    for (const std::int32_t f : around(v)) {
        const Triangle& t = face(f);
        const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        fan.push_back({v, t[(k + 1) % 3], t[(k + 2) % 3]});
    }
    double least = chord_;
    std::int32_t to = -1;
    for (const Triangle& t : fan) {
        const double highest = highest_edge(fan, t[1]);
        if (highest <= least) least = highest, to = t[1];
    }
    if (to < 0) return false;
    const std::vector<std::int32_t> faces = around(v);
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const auto& [old, r, s] = fan[i];
        if (r == to || s == to)
            remove(faces[i]);
        else
            replace(faces[i], {to, r, s});
    }
    return true;
}

}  // namespace

void thin(const CurvedTriangle& patch, double chord, PatchMesh& mesh) {
    Thinner(patch, chord, mesh).run();
}

}  // namespace pfgeom
