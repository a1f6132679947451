#include "pfgeom/polygonize/surface_mesh.h"

#include <algorithm>
#include <utility>

namespace pfgeom {

void SurfaceMesh::find_neighbours() {
    twins_.assign(3 * faces_.size(), -1);
    // Half-edges listed by their lower vertex (counting sort), then matched within each list.
    std::vector<std::int32_t> first(position.size() + 1, 0), listed(twins_.size());
    const auto low = [this](std::int32_t h) { return std::min(from(h), to(h)); };
    for (std::int32_t h = 0; h < half_edges(); ++h) ++first[low(h)];
    std::int32_t sum = 0;
    for (std::int32_t& f : first) sum += std::exchange(f, sum);
    for (std::int32_t h = 0; h < half_edges(); ++h) listed[first[low(h)]++] = h;
    for (std::size_t v = 0, begin = 0; v < position.size(); begin = first[v++])
        for (std::size_t i = begin; i < static_cast<std::size_t>(first[v]); ++i)
            for (std::size_t k = i + 1; k < static_cast<std::size_t>(first[v]) && twins_[listed[i]] < 0; ++k)
                if (from(listed[i]) == to(listed[k]) && to(listed[i]) == from(listed[k]))
                    glue(listed[i], listed[k]);
}

bool SurfaceMesh::joined(std::int32_t h, std::int32_t vertex) const {
    std::int32_t spoke = h;
    do {
        if (to(spoke) == vertex) return true;
        spoke = twin(previous(spoke));
    } while (spoke != h);
    return false;
}

int SurfaceMesh::valence(std::int32_t h) const {
    int n = 0;
    for_each_spoke(h, [&](std::int32_t) { ++n; });
    return n;
}

//        c                c          h: a→b in the triangle abc, g: b→a in the triangle bad; m is put
//        between.
//      / | .            / | .        abc becomes amc and mbc, bad becomes mad and bmd;
//    a --+-- b   →    a - m - b      h stays a→m, g becomes m→a.
//      . | /            . | /
//        d                d
void SurfaceMesh::split(std::int32_t h, std::int32_t vertex) {
    const std::int32_t g = twin(h), b = to(h), c = apex(h), d = apex(g);
    const std::int32_t outer_bc = twin(next(h)), outer_db = twin(previous(g));
    const auto upper = static_cast<std::int32_t>(faces_.size()), lower = upper + 1;
    faces_.push_back({vertex, b, c});
    faces_.push_back({b, vertex, d});
    twins_.resize(twins_.size() + 6);
    faces_[next(h) / 3][next(h) % 3] = vertex;
    faces_[g / 3][g % 3] = vertex;
    glue(3 * upper, 3 * lower);
    glue(3 * upper + 1, outer_bc);
    glue(3 * upper + 2, next(h));
    glue(3 * lower + 1, previous(g));
    glue(3 * lower + 2, outer_db);
}

// h: a→b in abc, g: b→a in bad; then the triangles are h: c→d in cdb, g: d→c in dca.
void SurfaceMesh::flip(std::int32_t h) {
    const std::int32_t g = twin(h), a = from(h), b = to(h), c = apex(h), d = apex(g);
    const std::int32_t bc = twin(next(h)), ca = twin(previous(h)), ad = twin(next(g)), db = twin(previous(g));
    faces_[h / 3][h % 3] = c;
    faces_[next(h) / 3][next(h) % 3] = d;
    faces_[previous(h) / 3][previous(h) % 3] = b;
    faces_[g / 3][g % 3] = d;
    faces_[next(g) / 3][next(g) % 3] = c;
    faces_[previous(g) / 3][previous(g) % 3] = a;
    glue(next(h), db);
    glue(previous(h), bc);
    glue(next(g), ca);
    glue(previous(g), ad);
}

bool SurfaceMesh::collapse(std::int32_t h) {
    const std::int32_t g = twin(h), b = to(h), c = apex(h), d = apex(g);
    // The link condition: a and b share just the neighbours c and d, which keep at least three edges each.
    if (c == d || valence(previous(h)) <= 3 || valence(previous(g)) <= 3) return false;
    std::int32_t spoke = twin(previous(h));
    for (; to(spoke) != d; spoke = twin(previous(spoke)))
        if (to(spoke) != c && joined(g, to(spoke))) return false;
    for (spoke = twin(previous(h)); spoke != h; spoke = twin(previous(spoke)))
        faces_[spoke / 3][spoke % 3] = b;
    faces_[g / 3] = faces_[h / 3] = {-1, -1, -1};
    glue(twin(next(h)), twin(previous(h)));
    glue(twin(next(g)), twin(previous(g)));
    return true;
}

void SurfaceMesh::compact() {
    std::vector<Triangle> kept;
    std::vector<std::int32_t> row(position.size(), -1);
    for (const Triangle& f : faces_)
        if (f[0] >= 0) {
            kept.push_back(f);
            for (const std::int32_t v : f) row[v] = 0;
        }
    std::int32_t count = 0;
    for (std::size_t v = 0; v < row.size(); ++v) {
        if (row[v] < 0) continue;
        position[count] = position[v];
        normal[count] = normal[v];
        row[v] = count++;
    }
    position.resize(count);
    normal.resize(count);
    for (Triangle& f : kept)
        for (std::int32_t& v : f) v = row[v];
    set_faces(std::move(kept));
}

}  // namespace pfgeom
