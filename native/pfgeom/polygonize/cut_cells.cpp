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

// The same of any field: false position, where it gains little with half the value of the end that stays.
// Source: M. Dowell, P. Jarratt, "A modified regula falsi method", BIT 11, 1971.
double zero_between(const ScalarField& field, const Vec3& a, const Vec3& b) {
    constexpr int kSteps = 40;
    constexpr double kClose = 1e-7;  // of the segment
    double t0 = 0, t1 = 1, f0 = field.value(a), f1 = field.value(b), last = 0.5;
    for (int i = 0, side = 0; i < kSteps; ++i) {
        const double guess = t0 + (t1 - t0) * (f0 / (f0 - f1));
        const double t = guess > t0 && guess < t1 ? guess : (t0 + t1) / 2;
        const double f = field.value(a + (b - a) * t);
        const bool close = std::abs(t - last) <= kClose;
        last = t;
        if (f == 0 || close) break;
        const bool left = (f < 0) == (f0 < 0);
        (left ? t0 : t1) = t;
        (left ? f0 : f1) = f;
        if (side == (left ? 1 : 2)) (left ? f1 : f0) /= 2;
        side = left ? 1 : 2;
    }
    return last;
}

double zero_between(const CutSolid& solid, std::int32_t question, const Vec3& a, const Vec3& b) {
    return solid.is_quadric(question) ? zero_between(solid.quadric(question), a, b)
                                      : zero_between(*solid.smooth(question).field, a, b);
}

class Cutting {
  public:
    Cutting(const CutSolid& solid, double snap, std::size_t max_cells, TreeCells& cells, const Task& task)
        : solid_(solid), snap_(snap), max_cells_(max_cells), cells_(cells), task_(task), known_(kKnown) {}

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
    bool follow(std::int32_t& node, const Tetrahedron& t, bool may_cut, bool& inside);
    bool follow_operation(std::int32_t node, const Tetrahedron& t, bool may_cut, bool& inside);
    void cut(const Tetrahedron& t, std::int32_t question);
    double distance(std::int32_t vertex, std::int32_t question) const {
        return cells_.distance(solid_, vertex, question);
    }
    int sign(std::int32_t vertex, std::int32_t question);
    Signs signs(const Tetrahedron& t, std::int32_t question);
    bool high_at_centre(const Tetrahedron& t, std::int32_t question) const;
    Side examine(std::int32_t node, const Tetrahedron& t);
    Side examine_operation(std::int32_t node, const Tetrahedron& t);

    const CutSolid& solid_;
    double snap_;
    std::size_t max_cells_;
    TreeCells& cells_;
    const Task& task_;
    TetEdgeTable cuts_;
    std::vector<Known> known_;
    std::vector<std::int32_t> reached_;  // leaves of the present cell
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

// True once what is open of the solid has answers: `node` then says which. Else one more edge is cut.
bool Cutting::advance(Tetrahedron& t, bool may_cut) {
    reached_.clear();
    bool inside = false;
    if (!follow(t.node, t, may_cut, inside)) return false;
    if (!solid_.combined()) {
        t.node = reached_.front();
        return true;
    }
    t.node = static_cast<std::int32_t>(cells_.leaves.size());
    cells_.leaves.push_back(static_cast<std::int32_t>(2 * reached_.size()) + (inside ? 1 : 0));
    cells_.leaves.insert(cells_.leaves.end(), reached_.begin(), reached_.end());
    return true;
}

// Follows the answers down, to leaves that go to reached_; `node` is then where the way ended. False where a
// question with both answers matters and has been given a cut: pieces go on from there, since an answer that
// did not matter stays given.
bool Cutting::follow(std::int32_t& node, const Tetrahedron& t, bool may_cut, bool& inside) {
    for (;;) {
        const OpenNode n = cells_.open[node];
        if (n.question == SolidNode::kLeaf) {
            reached_.push_back(n.low);
            inside = solid_.whole()[n.low].inside;
            return true;
        }
        if (n.question < 0) return follow_operation(node, t, may_cut, inside);
        const Signs s = signs(t, n.question);
        bool high = s.high;
        if (s.high == s.low) {
            if (s.high && may_cut && examine(node, t) == Side::both) {
                cut(t, n.question);
                return false;
            }
            high = high_at_centre(t, n.question);  // either is right
        }
        node += high ? 1 : n.low;
    }
}

// An operand that settles the operation speaks for it, else both do.
bool Cutting::follow_operation(std::int32_t node, const Tetrahedron& t, bool may_cut, bool& inside) {
    const OpenNode n = cells_.open[node];
    std::int32_t first = node + 1, second = node + n.low;
    if (n.question == SolidNode::kComplement) {
        const bool done = follow(first, t, may_cut, inside);
        inside = !inside;
        return done;
    }
    const bool settles = n.question == SolidNode::kUnite;
    if (may_cut && examine(second, t) == (settles ? Side::inside : Side::outside))
        return follow(second, t, may_cut, inside);
    const std::size_t before = reached_.size();
    if (!follow(first, t, may_cut, inside)) return false;
    if (inside == settles) return true;
    const std::size_t between = reached_.size();
    if (!follow(second, t, may_cut, inside)) return false;
    if (inside == settles)
        reached_.erase(reached_.begin() + static_cast<std::ptrdiff_t>(before),
                       reached_.begin() + static_cast<std::ptrdiff_t>(between));
    return true;
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
    cells_.position.push_back(pa + (pb - pa) * zero_between(solid_, question, pa, pb));
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
    if (n.question == SolidNode::kLeaf) return solid_.whole()[n.low].inside ? Side::inside : Side::outside;
    if (n.question < 0) return examine_operation(node, t);
    const Signs s = signs(t, n.question);
    if (s.high != s.low) return examine(node + (s.high ? 1 : n.low), t);
    if (!s.high) return examine(node + (high_at_centre(t, n.question) ? 1 : n.low), t);
    const Side high = examine(node + 1, t);
    return high != Side::both && high == examine(node + n.low, t) ? high : Side::both;
}

Side Cutting::examine_operation(std::int32_t node, const Tetrahedron& t) {
    const OpenNode n = cells_.open[node];
    const Side first = examine(node + 1, t);
    if (n.question == SolidNode::kComplement)
        return first == Side::both ? first : first == Side::inside ? Side::outside : Side::inside;
    const Side settles = n.question == SolidNode::kUnite ? Side::inside : Side::outside;
    if (first == settles) return settles;
    const Side second = examine(node + n.low, t);
    return first == Side::both && second != settles ? Side::both : second;
}

}  // namespace

void cut_cells(const CutSolid& solid, double snap, std::size_t max_cells, TreeCells& cells,
               const Task& task) {
    Cutting(solid, snap, max_cells, cells, task).run();
}

}  // namespace pfgeom
