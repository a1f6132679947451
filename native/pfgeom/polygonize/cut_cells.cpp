// Cuts: a tetrahedron in which a question that matters has both answers is cut at an edge, where the
// question's value is zero, and with it every other one at that edge, until each tetrahedron has one answer
// to each question. Nothing but edges is ever cut, so the partition stays conforming whatever the signs are,
// and the border between inside and outside is closed whatever the tree and the rounding are.
//
// Values at vertices are exact and not interpolated: where a question follows from others it does so at all
// vertices, nothing false appears between nearly equal quadrics, and tangent ones meet where they should.
#include "pfgeom/base/error.h"
#include "pfgeom/polygonize/lattice.h"
#include "pfgeom/polygonize/tree_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pfgeom {
namespace {

// Of cuts, one in each. Beyond, the centre of a piece decides: quadrics that cross an edge twice can make it
// endless.
constexpr int kRounds = 100;
constexpr std::size_t kKnown = 1 << 16;  // signs that are remembered

enum class Side : std::int8_t { outside, inside, both };

// Where a quadric with values of different sign at the ends of a segment is zero on it, from 0 to 1.
double zero_between(const Quadric& q, const Vec3& a, const Vec3& b) {
    const double qa = q.value(a), qb = q.value(b), qm = q.value((a + b) * 0.5);
    const double c2 = 2 * (qa + qb - 2 * qm), c1 = qb - qa - c2;
    const double root = std::sqrt(std::max(0.0, c1 * c1 - 4 * c2 * qa));
    const double half = -0.5 * (c1 < 0 ? c1 - root : c1 + root);
    for (const double t : {qa / half, half / c2, qa / (qa - qb)})
        if (t > 0 && t < 1) return t;
    return 0.5;
}

class Cutting {
  public:
    Cutting(const TreePruner& tree, double snap, std::size_t max_cells, TreeCells& cells, const Task& task)
        : tree_(tree), snap_(snap), max_cells_(max_cells), cells_(cells), task_(task), known_(kKnown) {}

    // In rounds, each cell asking for one cut in each: no cell runs ahead.
    void run() {
        std::vector<Tetrahedron> open = std::move(cells_.cells);
        std::vector<Tetrahedron>& done = cells_.cells = {};
        for (int round = 0; !open.empty(); ++round) {
            match(open);
            if (open.size() + done.size() > max_cells_)
                throw LimitExceeded("polygonize: more than max_cells = " + std::to_string(max_cells_) +
                                    " cells");
            auto kept = open.begin();
            for (std::size_t i = 0; i < open.size(); ++i) {
                if (i % 256 == 0) task_.check();
                Tetrahedron t = open[i];
                if (advance(t, round < kRounds))
                    done.push_back(t);
                else
                    *kept++ = t;
            }
            open.erase(kept, open.end());
        }
        match(done);
        cells_.open = {};
    }

  private:
    struct Known {
        std::int32_t vertex = -1, question = -1;
        int sign = 0;
    };
    struct Signs {
        bool high = false, low = false;
    };

    void match(std::vector<Tetrahedron>& cells) const;
    bool cut_where_cut(const Tetrahedron& t, std::vector<Tetrahedron>& pieces) const;
    bool advance(Tetrahedron& t, bool may_cut);
    void cut(const Tetrahedron& t, std::int32_t question);
    double distance(std::int32_t vertex, std::int32_t question) const {
        return cells_.distance(tree_, vertex, question);
    }
    int sign(std::int32_t vertex, std::int32_t question);
    Signs signs(const Tetrahedron& t, std::int32_t question);
    bool high_at_centre(const Tetrahedron& t, std::int32_t question) const;
    Side examine(std::int32_t node, const Tetrahedron& t);

    const TreePruner& tree_;
    double snap_;
    std::size_t max_cells_;
    TreeCells& cells_;
    const Task& task_;
    TetEdgeTable cuts_;
    std::vector<Known> known_;
};

// Cuts the cells wherever an edge of theirs has been: one piece stays in place, the others go to the end. A
// second list would be the most memory that polygonizing takes.
void Cutting::match(std::vector<Tetrahedron>& cells) const {
    std::vector<Tetrahedron> pieces;
    const std::size_t count = cells.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 256 == 0) task_.check();
        bool placed = false;
        for (pieces.assign(1, cells[i]); !pieces.empty();) {
            const Tetrahedron t = pieces.back();
            pieces.pop_back();
            if (cut_where_cut(t, pieces)) continue;
            if (placed)
                cells.push_back(t);
            else
                cells[i] = t;
            placed = true;
        }
    }
}

// Follows the oldest cut at an edge: then both tetrahedra at a face cut it in the same order.
bool Cutting::cut_where_cut(const Tetrahedron& t, std::vector<Tetrahedron>& pieces) const {
    std::int32_t oldest = -1;
    std::array<int, 2> edge{};
    for (const auto& e : kTetrahedronEdges) {
        const std::int32_t vertex = cuts_.find(t.vertex[e[0]], t.vertex[e[1]]);
        if (vertex < 0 || (oldest >= 0 && oldest < vertex)) continue;
        oldest = vertex;
        edge = e;
    }
    if (oldest < 0) return false;
    for (const Tetrahedron& half : halves(t, edge[0], edge[1], oldest)) pieces.push_back(half);
    return true;
}

// Follows the answers down the tree. True at a leaf; at a question with both answers one more edge is cut.
bool Cutting::advance(Tetrahedron& t, bool may_cut) {
    for (;;) {
        const OpenNode node = cells_.open[t.node];
        if (node.question < 0) {
            t.node = node.low;
            return true;
        }
        const Signs s = signs(t, node.question);
        bool high = s.high;
        if (s.high == s.low) {
            if (s.high && may_cut && examine(t.node, t) == Side::both) {
                cut(t, node.question);
                return false;
            }
            high = high_at_centre(t, node.question);  // either is right
        }
        t.node += high ? 1 : node.low;
    }
}

// At the oldest of the edges with ends on both sides. Were newer ones cut first, two questions could cut a
// triangle in turns without end, each leaving the edge between its oldest corners to the other.
void Cutting::cut(const Tetrahedron& t, std::int32_t question) {
    std::pair<std::int32_t, std::int32_t> oldest{std::numeric_limits<std::int32_t>::max(), 0};
    for (const auto& [i, k] : kTetrahedronEdges) {
        const std::int32_t a = t.vertex[i], b = t.vertex[k];
        if (sign(a, question) * sign(b, question) < 0)
            oldest = std::min(oldest, {std::max(a, b), std::min(a, b)});
    }
    const auto [b, a] = oldest;
    if (cuts_.find(a, b) >= 0) return;
    const Vec3 pa = cells_.position[a], pb = cells_.position[b];
    const Zeros za = cells_.zeros[a], zb = cells_.zeros[b];
    Zeros zeros = kNoZeros;
    zeros[0] = question;
    std::size_t n = 1;
    for (const std::int32_t q : za)
        if (q >= 0 && n < zeros.size() && std::find(zb.begin(), zb.end(), q) != zb.end()) zeros[n++] = q;
    cuts_.insert(a, b, static_cast<std::int32_t>(cells_.position.size()));
    cells_.position.push_back(pa + (pb - pa) * zero_between(tree_.quadric(question), pa, pb));
    cells_.zeros.push_back(zeros);
}

// 0 within `snap`, and where the distance is not a number.
int Cutting::sign(std::int32_t vertex, std::int32_t question) {
    const std::uint64_t key = static_cast<std::uint64_t>(vertex) << 16 ^ static_cast<std::uint64_t>(question);
    Known& known = known_[hash_key(key) & (kKnown - 1)];
    if (known.vertex != vertex || known.question != question) {
        const double d = distance(vertex, question);
        known = {vertex, question, d > snap_ ? 1 : d < -snap_ ? -1 : 0};
    }
    return known.sign;
}

Cutting::Signs Cutting::signs(const Tetrahedron& t, std::int32_t question) {
    Signs found;
    for (const std::int32_t v : t.vertex) {
        const int s = sign(v, question);
        found.high |= s > 0;
        found.low |= s < 0;
    }
    return found;
}

bool Cutting::high_at_centre(const Tetrahedron& t, std::int32_t question) const {
    double sum = 0;
    for (const std::int32_t v : t.vertex) sum += distance(v, question);
    return sum >= 0;
}

// What the subtree says in the tetrahedron, going by its corners.
Side Cutting::examine(std::int32_t node, const Tetrahedron& t) {
    const OpenNode n = cells_.open[node];
    if (n.question < 0) return tree_.whole()[n.low].inside ? Side::inside : Side::outside;
    const Signs s = signs(t, n.question);
    if (s.high != s.low) return examine(node + (s.high ? 1 : n.low), t);
    if (!s.high) return examine(node + (high_at_centre(t, n.question) ? 1 : n.low), t);
    const Side high = examine(node + 1, t);
    return high != Side::both && high == examine(node + n.low, t) ? high : Side::both;
}

}  // namespace

void cut_cells(const TreePruner& tree, double snap, std::size_t max_cells, TreeCells& cells,
               const Task& task) {
    Cutting(tree, snap, max_cells, cells, task).run();
}

}  // namespace pfgeom
