#include "pfgeom/polygonize/labelled_mesh.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

class Manifold {
  public:
    explicit Manifold(TreeBoundary&& boundary)
        : position_(std::move(boundary.position)),
          faces_(std::move(boundary.faces)),
          label_(std::move(boundary.label)) {}

    LabelledMesh run() {
        pair_half_edges();
        part_fans();
        LabelledMesh out;
        out.label = std::move(label_);
        const std::vector<std::int32_t> doubled = doubled_edges();
        out.mesh.position = std::move(position_);
        out.mesh.normal.resize(out.mesh.position.size());
        out.mesh.set_faces(std::move(faces_), std::move(twins_));
        for (const std::int32_t h : doubled) {
            const Vec3 middle =
                (out.mesh.position[out.mesh.from(h)] + out.mesh.position[out.mesh.to(h)]) * 0.5;
            out.split(h, middle);
        }
        return out;
    }

  private:
    std::int32_t from(std::int32_t h) const { return faces_[h / 3][h % 3]; }
    std::int32_t to(std::int32_t h) const { return from(SurfaceMesh::next(h)); }
    std::pair<std::int32_t, std::int32_t> ends(std::int32_t h) const {
        return {std::min(from(h), to(h)), std::max(from(h), to(h))};
    }
    bool same_ends(std::int32_t g, std::int32_t h) const { return ends(g) == ends(h); }
    void glue(std::int32_t g, std::int32_t h) {
        twins_[g] = h;
        twins_[h] = g;
    }
    std::vector<std::int32_t> by_edge() const;
    void pair_half_edges();
    void pair_around(const std::vector<std::int32_t>& edge);
    double turn(std::int32_t h, const Vec3& axis, const Vec3& zero) const;
    void part_fans();
    std::vector<std::int32_t> doubled_edges() const;

    std::vector<Vec3> position_;
    std::vector<Triangle> faces_;
    std::vector<Label> label_;
    std::vector<std::int32_t> twins_;
};

// Half-edges with the same ends stand together.
std::vector<std::int32_t> Manifold::by_edge() const {
    std::vector<std::size_t> first(position_.size() + 1, 0);
    const auto n = static_cast<std::int32_t>(3 * faces_.size());
    for (std::int32_t h = 0; h < n; ++h) ++first[ends(h).first + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::int32_t> list(3 * faces_.size());
    std::vector<std::size_t> next = first;
    for (std::int32_t h = 0; h < n; ++h) list[next[ends(h).first]++] = h;
    for (std::size_t v = 0; v + 1 < first.size(); ++v)
        std::sort(list.begin() + static_cast<std::ptrdiff_t>(first[v]),
                  list.begin() + static_cast<std::ptrdiff_t>(first[v + 1]),
                  [&](std::int32_t g, std::int32_t h) {
                      return ends(g).second != ends(h).second ? ends(g).second < ends(h).second : g < h;
                  });
    return list;
}

void Manifold::pair_half_edges() {
    twins_.assign(3 * faces_.size(), -1);
    const std::vector<std::int32_t> list = by_edge();
    for (std::size_t i = 0, next; i < list.size(); i = next) {
        const std::int32_t h = list[i];
        for (next = i + 1; next < list.size() && same_ends(h, list[next]);) ++next;
        if (next == i + 2)
            glue(h, list[i + 1]);
        else
            pair_around({list.begin() + static_cast<std::ptrdiff_t>(i),
                         list.begin() + static_cast<std::ptrdiff_t>(next)});
    }
}

// Each face with the one across the inside: for one whose half-edge runs along the edge, that is the next
// that runs against it, clockwise about the edge.
void Manifold::pair_around(const std::vector<std::int32_t>& edge) {
    const Vec3 axis = normalized(position_[to(edge[0])] - position_[from(edge[0])]);
    const Vec3 zero = normalized(position_[from(SurfaceMesh::previous(edge[0]))] - position_[from(edge[0])]);
    std::vector<std::int32_t> along, against;
    for (const std::int32_t h : edge) (from(h) == from(edge[0]) ? along : against).push_back(h);
    for (const std::int32_t h : along) {
        const double start = turn(h, axis, zero);
        double least = 9;
        std::int32_t best = -1;
        for (const std::int32_t g : against) {
            if (twins_[g] >= 0) continue;
            double back = start - turn(g, axis, zero);
            if (back <= 0) back += 4;
            if (back >= least) continue;
            least = back;
            best = g;
        }
        glue(h, best);
    }
}

// A face's direction about the axis, counter-clockwise from `zero`, as a number from 0 to 4 that grows with
// the angle.
double Manifold::turn(std::int32_t h, const Vec3& axis, const Vec3& zero) const {
    const Vec3 d = position_[from(SurfaceMesh::previous(h))] - position_[from(h)];
    const Vec3 u = zero - axis * dot(zero, axis);
    const double x = dot(d, u), y = dot(d, cross(axis, u)), size = std::abs(x) + std::abs(y);
    if (!(size > 0)) return 0;
    return y >= 0 ? 1 - x / size : 3 + x / size;
}

// A vertex of its own for each fan of faces.
void Manifold::part_fans() {
    std::vector<char> seen(twins_.size()), taken(position_.size());
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(twins_.size()); ++h) {
        if (seen[h]) continue;
        std::int32_t vertex = from(h);
        if (taken[vertex]) {
            position_.push_back(position_[vertex]);
            vertex = static_cast<std::int32_t>(position_.size()) - 1;
        } else {
            taken[vertex] = 1;
        }
        for (std::int32_t spoke = h; !seen[spoke]; spoke = twins_[SurfaceMesh::previous(spoke)]) {
            seen[spoke] = 1;
            faces_[spoke / 3][spoke % 3] = vertex;
        }
    }
}

// The edges whose ends are joined by others, too.
std::vector<std::int32_t> Manifold::doubled_edges() const {
    std::vector<std::int32_t> doubled;
    const std::vector<std::int32_t> list = by_edge();
    for (std::size_t i = 0, next; i < list.size(); i = next) {
        for (next = i + 1; next < list.size() && same_ends(list[i], list[next]);) ++next;
        for (std::size_t k = i; next > i + 2 && k < next; ++k)
            if (list[k] < twins_[list[k]]) doubled.push_back(list[k]);
    }
    return doubled;
}

}  // namespace

std::vector<Label> LabelledMesh::labels_around(std::int32_t half_edge) const {
    std::vector<Label> labels;
    mesh.for_each_spoke(half_edge, [&](std::int32_t spoke) {
        if (std::find(labels.begin(), labels.end(), label_at(spoke)) == labels.end())
            labels.push_back(label_at(spoke));
    });
    return labels;
}

std::int32_t LabelledMesh::split(std::int32_t half_edge, const Vec3& point) {
    const auto vertex = static_cast<std::int32_t>(mesh.position.size());
    mesh.position.push_back(point);
    mesh.normal.emplace_back();
    label.push_back(label_at(half_edge));
    label.push_back(label_at(mesh.twin(half_edge)));
    mesh.split(half_edge, vertex);
    return vertex;
}

void LabelledMesh::compact() {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < label.size(); ++f)
        if (mesh.alive(static_cast<std::int32_t>(f))) label[kept++] = label[f];
    label.resize(kept);
    mesh.compact();
}

LabelledMesh manifold_of(TreeBoundary&& boundary) {
    return Manifold(std::move(boundary)).run();
}

}  // namespace pfgeom
