#include "pfgeom/polygonize/tree_boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

struct CellFace {
    std::array<std::int32_t, 3> sorted{};
    std::int32_t cell = -1;
    std::int32_t opposite = 0;  // corner of the cell
};

class Boundary {
  public:
    Boundary(const CutSolid& solid, TreeCells&& cells, const Task& task)
        : solid_(solid), cells_(std::move(cells)), task_(task) {
        name_labels();
        const std::vector<SolidNode>& nodes = solid_.whole();
        parent_.assign(nodes.size(), -1);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].question == SolidNode::kLeaf) continue;
            parent_[i + 1] = static_cast<std::int32_t>(i);
            if (nodes[i].low >= 0) parent_[nodes[i].low] = static_cast<std::int32_t>(i);
        }
    }

    TreeBoundary run() {
        group_cells();
        std::vector<CellFace> faces;
        for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
            if (v % 256 == 0) task_.check();
            collect_faces(static_cast<std::int32_t>(v), faces);
            add_border(faces);
        }
        out_.position = std::move(cells_.position);
        return std::move(out_);
    }

  private:
    void name_labels();
    using Leaves = std::span<const std::int32_t>;
    void group_cells();
    void collect_faces(std::int32_t vertex, std::vector<CellFace>& faces) const;
    void add_border(const std::vector<CellFace>& faces);
    CellAnswer answer_beyond(const CellFace& face);
    void add(const CellFace& face, Leaves in, Leaves out, bool turned);
    Label label_of(const Triangle& face, Leaves in, Leaves out) const;
    double distance(std::int32_t question, const Triangle& face) const;

    const CutSolid& solid_;
    TreeCells cells_;
    const Task& task_;
    // Each cell at the lowest and at the second lowest of its vertices: the lowest of a face is one of the
    // two.
    std::vector<std::size_t> first_;  // by vertex, in grouped_
    std::vector<std::int32_t> grouped_;
    std::vector<std::int32_t> parent_;  // by node
    std::vector<Label> label_;          // by question: of its high side
    std::vector<std::int32_t> beyond_;  // leaves where there is no cell
    TreeBoundary out_;
};

// Questions that ask the same have one label: that of the first of them.
void Boundary::name_labels() {
    for (std::size_t i = 0; i < solid_.questions(); ++i) {
        const Quadric& q = solid_.quadric(static_cast<std::int32_t>(i));
        Quadric negative = q;
        for (double& c : negative.c) c = -c;
        Label label = 2 * static_cast<Label>(i);
        const bool quadric = solid_.is_quadric(static_cast<std::int32_t>(i));
        for (std::size_t k = 0; quadric && k < i && label == 2 * static_cast<Label>(i); ++k) {
            if (solid_.quadric(static_cast<std::int32_t>(k)) == q) label = label_[k];
            if (solid_.quadric(static_cast<std::int32_t>(k)) == negative) label = label_[k] ^ 1;
        }
        label_.push_back(label);
    }
}

void Boundary::group_cells() {
    const auto for_each = [&](const auto& use) {
        for (std::size_t c = 0; c < cells_.cells.size(); ++c) {
            if (c % 4096 == 0) task_.check();
            std::array<std::int32_t, 4> v = cells_.cells[c].vertex;
            std::partial_sort(v.begin(), v.begin() + 2, v.end());
            use(v[0], static_cast<std::int32_t>(c));
            use(v[1], static_cast<std::int32_t>(c));
        }
    };
    first_.assign(cells_.position.size() + 1, 0);
    for_each([&](std::int32_t v, std::int32_t) { ++first_[v + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    grouped_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for_each([&](std::int32_t v, std::int32_t c) { grouped_[next[v]++] = c; });
}

// Those whose lowest vertex it is, equal ones side by side.
void Boundary::collect_faces(std::int32_t vertex, std::vector<CellFace>& faces) const {
    faces.clear();
    for (std::size_t k = first_[vertex]; k < first_[vertex + 1]; ++k) {
        const std::int32_t cell = grouped_[k];
        for (std::int32_t i = 0; i < 4; ++i) {
            CellFace face{.cell = cell, .opposite = i};
            for (std::size_t n = 0; n < 3; ++n)
                face.sorted[n] = cells_.cells[cell].vertex[kTetrahedronFaces[i][n]];
            std::sort(face.sorted.begin(), face.sorted.end());
            if (face.sorted[0] == vertex) faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end(), [](const CellFace& a, const CellFace& b) {
        return a.sorted != b.sorted ? a.sorted < b.sorted : a.cell < b.cell;
    });
}

// Of equal faces, those between inside and outside.
void Boundary::add_border(const std::vector<CellFace>& faces) {
    for (std::size_t i = 0, next; i < faces.size(); i = next) {
        const bool matched = i + 1 < faces.size() && faces[i + 1].sorted == faces[i].sorted;
        next = i + (matched ? 2 : 1);
        const CellAnswer here = cells_.answer(solid_, cells_.cells[faces[i].cell]);
        const CellAnswer there =
            matched ? cells_.answer(solid_, cells_.cells[faces[i + 1].cell]) : answer_beyond(faces[i]);
        if (here.inside == there.inside) continue;
        if (here.inside)
            add(faces[i], here.leaves, there.leaves, false);
        else if (matched)
            add(faces[i + 1], there.leaves, here.leaves, false);
        else
            add(faces[i], there.leaves, here.leaves, true);
    }
}

// Of a face without a second cell: the solid says the same all over there.
CellAnswer Boundary::answer_beyond(const CellFace& face) {
    Vec3 centre;
    for (const std::int32_t v : face.sorted) centre += cells_.position[v] / 3;
    beyond_.clear();
    const bool inside = solid_.contains(centre, beyond_);
    return {inside, beyond_};
}

void Boundary::add(const CellFace& face, Leaves in, Leaves out, bool turned) {
    const Tetrahedron& cell = cells_.cells[face.cell];
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = cell.vertex[kTetrahedronFaces[face.opposite][k]];
    if (turned) std::swap(t[1], t[2]);
    out_.faces.push_back(t);
    out_.label.push_back(label_of(t, in, out));
}

// Which question divides the leaves inside from those outside? The one on their paths whose zero set the face
// lies on; mostly it is that at which two paths part, but a cell in which an answer did not matter has got
// either.
Label Boundary::label_of(const Triangle& face, Leaves in, Leaves out) const {
    double least = std::numeric_limits<double>::infinity();
    Label best = 0;
    const auto consider = [&](std::int32_t node, bool inwards) {
        const std::int32_t question = solid_.whole()[node].question;
        if (least == 0 || question < 0) return;
        const double d = distance(question, face);
        if (!(d < least)) return;
        least = d;
        best = label_[question] ^ (inwards ? 0 : 1);
    };
    for (const std::int32_t from : in) {
        for (const std::int32_t to : out) {
            if (from == to) continue;
            std::int32_t a = from, b = to, before_a = from;
            while (a != b) {  // nodes stand after their parents
                if (a > b)
                    a = parent_[before_a = a];
                else
                    b = parent_[b];
            }
            consider(a, before_a == a + 1);
        }
    }
    for (const bool inside : {true, false})
        for (const std::int32_t leaf : inside ? in : out)
            for (std::int32_t child = leaf, at = parent_[leaf]; at >= 0; child = at, at = parent_[at])
                consider(at, (child == at + 1) == inside);
    return best;
}

// Of the farthest corner from the question's zero set.
double Boundary::distance(std::int32_t question, const Triangle& face) const {
    double most = 0;
    for (const std::int32_t v : face) {
        const double d = std::abs(cells_.distance(solid_, v, question));
        if (!(d <= most)) most = d;
    }
    return most;
}

}  // namespace

TreeBoundary boundary_of(const CutSolid& solid, TreeCells&& cells, const Task& task) {
    return Boundary(solid, std::move(cells), task).run();
}

}  // namespace pfgeom
