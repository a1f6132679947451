#include "pfgeom/codec/mesh_part_front.h"

namespace pfgeom {
namespace {

// Beyond 126 degrees an angle says nothing about what comes next: the oldest gate is as good.
constexpr int kWide = 406;

// Rises with the angle from x to y in the plane with the given normal: 1 - cos up to 180 degrees, 3 + cos
// after.
int pseudo_angle(const Vec3& x, const Vec3& y, const Vec3& normal) {
    constexpr int kQuarterTurn = Wedge::kNone / 4;
    const double lengths = std::sqrt(squared_norm(x) * squared_norm(y));
    if (!(lengths > 0)) return 0;
    const double cosine = std::clamp(dot(x, y) / lengths, -1.0, 1.0);
    const double turn = dot(normal, cross(x, y)) >= 0 ? 1 - cosine : 3 + cosine;
    return static_cast<int>(turn * kQuarterTurn);
}

}  // namespace

void Front::add_vertex(const GridPoint& p) {
    positions_.push_back(p);
    ends_.emplace_back();
}

int Front::wedge_angle(const Gate& gate, std::int32_t corner, std::int32_t other,
                       std::int32_t neighbour) const {
    const Vec3 normal = cross(at(gate.from) - at(gate.to), at(gate.apex) - at(gate.to));
    const Vec3 x = at(other) - at(corner), y = at(neighbour) - at(corner);
    return corner == gate.from ? pseudo_angle(x, y, normal) : pseudo_angle(y, x, normal);
}

Wedge Front::before(const Gate& gate) const {
    Wedge best;
    std::int32_t node = ends_[static_cast<std::size_t>(gate.from)].first[1];
    for (int i = 0; node >= 0 && i < kReach; ++i) {
        const Node& neighbour = nodes_[static_cast<std::size_t>(node)];
        const std::int32_t vertex = neighbour.gate.from;
        if (vertex != gate.to) {
            const int angle = wedge_angle(gate, gate.from, gate.to, vertex);
            if (best.vertex < 0 || angle < best.angle) best = {vertex, angle};
        }
        node = neighbour.next[1];
    }
    return best;
}

Wedge Front::after(const Gate& gate) const {
    Wedge best;
    std::int32_t node = ends_[static_cast<std::size_t>(gate.to)].first[0];
    for (int i = 0; node >= 0 && i < kReach; ++i) {
        const Node& neighbour = nodes_[static_cast<std::size_t>(node)];
        const std::int32_t vertex = neighbour.gate.to;
        if (vertex != gate.from) {
            const int angle = wedge_angle(gate, gate.to, gate.from, vertex);
            if (best.vertex < 0 || angle < best.angle) best = {vertex, angle};
        }
        node = neighbour.next[0];
    }
    return best;
}

std::int32_t Front::find(std::int32_t from, std::int32_t to) const {
    std::int32_t node = ends_[static_cast<std::size_t>(from)].first[0];
    for (int i = 0; node >= 0 && i < kReach; ++i) {
        if (nodes_[static_cast<std::size_t>(node)].gate.to == to) return node;
        node = nodes_[static_cast<std::size_t>(node)].next[0];
    }
    return -1;
}

void Front::schedule(std::int32_t node) {
    const Node& n = nodes_[static_cast<std::size_t>(node)];
    const int angle = before(n.gate).angle;
    queue_.push({angle < kWide ? angle : Wedge::kNone, n.serial, node});
}

void Front::open(const Gate& gate) {
    if (unused_.empty()) {
        unused_.push_back(static_cast<std::int32_t>(nodes_.size()));
        nodes_.emplace_back();
    }
    const std::int32_t node = unused_.back();
    unused_.pop_back();
    nodes_[static_cast<std::size_t>(node)] = {gate, ++serial_, {-1, -1}, {-1, -1}};
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        auto& first = ends_[static_cast<std::size_t>(side == 0 ? gate.from : gate.to)].first[side];
        nodes_[static_cast<std::size_t>(node)].next[side] = first;
        if (first >= 0) nodes_[static_cast<std::size_t>(first)].previous[side] = node;
        first = node;
    }
    schedule(node);
    std::int32_t later = ends_[static_cast<std::size_t>(gate.to)].first[0];  // their wedge is new
    for (int i = 0; later >= 0 && i < kReach; ++i) {
        schedule(later);
        later = nodes_[static_cast<std::size_t>(later)].next[0];
    }
}

void Front::close(std::int32_t node) {
    Node& n = nodes_[static_cast<std::size_t>(node)];
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const std::int32_t vertex = side == 0 ? n.gate.from : n.gate.to;
        if (n.next[side] >= 0)
            nodes_[static_cast<std::size_t>(n.next[side])].previous[side] = n.previous[side];
        if (n.previous[side] >= 0)
            nodes_[static_cast<std::size_t>(n.previous[side])].next[side] = n.next[side];
        else
            ends_[static_cast<std::size_t>(vertex)].first[side] = n.next[side];
    }
    n.serial = 0;
    unused_.push_back(node);
}

// The face has the edge from -> to.
void Front::edge(std::int32_t from, std::int32_t to, const Gate& opened) {
    const std::int32_t node = find(from, to);
    if (node >= 0)
        close(node);
    else
        open(opened);
}

void Front::seed(std::int32_t a, std::int32_t b, std::int32_t c) {
    edge(a, b, {b, a, c, false, 0});
    grow({a, b, -1, false, 0}, c, false, 0);
}

void Front::grow(const Gate& gate, std::int32_t c, bool flipped, double bend) {
    const std::int32_t a = gate.from, b = gate.to;
    for (const std::int32_t v : {a, b, c}) ++ends_[static_cast<std::size_t>(v)].faces;
    edge(b, c, {c, b, a, flipped, bend});
    edge(c, a, {a, c, b, flipped, bend});
}

bool Front::pop(Gate& gate) {
    while (!queue_.empty()) {
        const Candidate top = queue_.top();
        queue_.pop();
        if (nodes_[static_cast<std::size_t>(top.node)].serial != top.serial) continue;
        gate = nodes_[static_cast<std::size_t>(top.node)].gate;
        close(top.node);
        return true;
    }
    return false;
}

}  // namespace pfgeom
