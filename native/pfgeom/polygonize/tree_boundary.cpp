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
    Boundary(const TreePruner& tree, TreeCells&& cells, const Task& task)
        : tree_(tree), cells_(std::move(cells)), task_(task) {
        name_labels();
        const PrunedTree& nodes = tree_.whole();
        parent_.assign(nodes.size(), -1);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i].question >= 0) parent_[i + 1] = parent_[nodes[i].low] = static_cast<std::int32_t>(i);
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
    bool inside(std::int32_t node) const { return tree_.whole()[node].inside; }
    void group_cells();
    void collect_faces(std::int32_t vertex, std::vector<CellFace>& faces) const;
    void add_border(const std::vector<CellFace>& faces);
    std::int32_t node_at(const CellFace& face) const;
    void add(const CellFace& face, std::int32_t in, std::int32_t out, bool turned);
    Label label_of(const Triangle& face, std::int32_t in, std::int32_t out) const;
    double distance(std::int32_t question, const Triangle& face) const;

    const TreePruner& tree_;
    TreeCells cells_;
    const Task& task_;
    // Each cell at the lowest and at the second lowest of its vertices: the lowest of a face is one of the
    // two.
    std::vector<std::size_t> first_;  // by vertex, in grouped_
    std::vector<std::int32_t> grouped_;
    std::vector<std::int32_t> parent_;  // by node
    std::vector<Label> label_;          // by question: of its high side
    TreeBoundary out_;
};

// Questions that ask the same have one label: that of the first of them.
void Boundary::name_labels() {
    for (std::size_t i = 0; i < tree_.questions(); ++i) {
        const Quadric& q = tree_.quadric(static_cast<std::int32_t>(i));
        Quadric negative = q;
        for (double& c : negative.c) c = -c;
        Label label = 2 * static_cast<Label>(i);
        for (std::size_t k = 0; k < i && label == 2 * static_cast<Label>(i); ++k) {
            if (tree_.quadric(static_cast<std::int32_t>(k)) == q) label = label_[k];
            if (tree_.quadric(static_cast<std::int32_t>(k)) == negative) label = label_[k] ^ 1;
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
        const std::int32_t node = cells_.cells[faces[i].cell].node;
        const std::int32_t beyond = matched ? cells_.cells[faces[i + 1].cell].node : node_at(faces[i]);
        if (inside(node) == inside(beyond)) continue;
        if (inside(node))
            add(faces[i], node, beyond, false);
        else if (matched)
            add(faces[i + 1], beyond, node, false);
        else
            add(faces[i], beyond, node, true);
    }
}

// The leaf beyond a face without a second cell: the tree says the same all over there.
std::int32_t Boundary::node_at(const CellFace& face) const {
    Vec3 centre;
    for (const std::int32_t v : face.sorted) centre += cells_.position[v] / 3;
    const PrunedTree& nodes = tree_.whole();
    std::int32_t at = 0;
    while (nodes[at].question >= 0)
        at = tree_.quadric(nodes[at].question).value(centre) >= 0 ? at + 1 : nodes[at].low;
    return at;
}

void Boundary::add(const CellFace& face, std::int32_t in, std::int32_t out, bool turned) {
    const Tetrahedron& cell = cells_.cells[face.cell];
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = cell.vertex[kTetrahedronFaces[face.opposite][k]];
    if (turned) std::swap(t[1], t[2]);
    out_.faces.push_back(t);
    out_.label.push_back(label_of(t, in, out));
}

// Which question divides the two leaves? The one on their paths whose zero set the face lies on; mostly it is
// that at which the paths part, but a cell in which an answer did not matter has got either.
Label Boundary::label_of(const Triangle& face, std::int32_t in, std::int32_t out) const {
    double least = std::numeric_limits<double>::infinity();
    Label best = 0;
    const auto consider = [&](std::int32_t node, bool inwards) {
        if (least == 0) return;
        const std::int32_t question = tree_.whole()[node].question;
        const double d = distance(question, face);
        if (!(d < least)) return;
        least = d;
        best = label_[question] ^ (inwards ? 0 : 1);
    };
    std::int32_t a = in, b = out, before_a = in;
    while (a != b) {  // nodes stand after their parents
        if (a > b)
            a = parent_[before_a = a];
        else
            b = parent_[b];
    }
    consider(a, before_a == a + 1);
    for (const std::int32_t leaf : {in, out})
        for (std::int32_t child = leaf, at = parent_[leaf]; at >= 0; child = at, at = parent_[at])
            consider(at, (child == at + 1) == (leaf == in));
    return best;
}

// Of the farthest corner from the question's zero set.
double Boundary::distance(std::int32_t question, const Triangle& face) const {
    double most = 0;
    for (const std::int32_t v : face) {
        const double d = std::abs(cells_.distance(tree_, v, question));
        if (!(d <= most)) most = d;
    }
    return most;
}

}  // namespace

TreeBoundary boundary_of(const TreePruner& tree, TreeCells&& cells, const Task& task) {
    return Boundary(tree, std::move(cells), task).run();
}

}  // namespace pfgeom
