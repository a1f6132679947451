#include "pfgeom/render/combined_ray.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

using Kind = CombinationStep::Kind;

// Crossings this close to one another, as a share of what the ray has come and of the size of the numbers,
// are one: what two equal faces leave between them is nothing. Hits are exact to some 1e-12.
constexpr double kTogether = 1e-9;

}  // namespace

CombinedPieces::CombinedPieces(const Model& model, const std::vector<CombinationNode>& tree) {
    for (const CombinationNode& what : tree) {
        Node node;
        node.kind = what.kind;
        node.a = what.a;
        node.b = what.b;
        const auto at = static_cast<std::int32_t>(nodes_.size());
        if (what.is_operand()) {
            node.first = static_cast<std::int32_t>(outer_.size());
            for (std::int32_t i = what.first; i < what.last; ++i) {
                const std::int32_t outer = model.objects[static_cast<std::size_t>(i)].cavity_of;
                outer_.push_back(outer < 0 ? -1 : node.first + outer - what.first);
                object_of_.push_back(i);
            }
            node.last = static_cast<std::int32_t>(outer_.size());
        } else {
            nodes_[static_cast<std::size_t>(what.a)].parent =
                nodes_[static_cast<std::size_t>(what.b)].parent = at;
        }
        nodes_.push_back(node);
    }
}

void CombinedPieces::set_operand(std::size_t node, std::span<const RayPiece> pieces) {
    const auto first = static_cast<std::size_t>(nodes_[node].first);
    for (std::size_t i = node_of_.size(); i < pieces.size(); ++i) {
        node_of_.push_back(static_cast<std::int32_t>(node));
        slot_of_.push_back(nodes_[node].first + pieces[i].object - object_of_[first]);
    }
}

// One ray on its way.
class CombinedRay {
  public:
    CombinedRay(const CombinedPieces& all, std::span<const RayPiece> pieces, const Ray& ray)
        : all_(all),
          pieces_(pieces),
          ray_(ray),
          speed_(norm(ray.direction)),
          inside_(all.nodes_.size(), 0),
          within_(all.outer_.size(), 0) {}

    // The piece's first crossing, and whether the ray begins within it.
    void add(std::int32_t piece, double from) {
        const SurfaceHit hit = next_hit(piece, from);
        if (!hit.found()) return;
        Crossing crossing;
        crossing.piece = piece;
        crossing.hit = hit;
        const RayPiece& p = pieces_[static_cast<std::size_t>(piece)];
        const bool begins =
            p.target->tells_sides() ? leaves(p, hit) : p.contains(ray_.at(from + (hit.t - from) / 2));
        look_ahead(crossing);
        if (begins) turn(piece, 1);
        crossings_.push_back(crossing);
    }

    SurfaceHit run(double to) {
        while (!crossings_.empty()) {
            const double t = least();
            if (!(t < to)) break;
            const bool before = inside_.back() != 0;
            SurfaceHit found;
            cross_until(t + together(t), before, found);
            if ((inside_.back() != 0) == before) continue;
            const bool along = dot(found.normal, ray_.direction) > 0;
            if (along != before) found.normal = -found.normal;
            return found;
        }
        return {};
    }

  private:
    struct Crossing {
        std::int32_t piece = -1;
        SurfaceHit hit, next;  // of a mesh part, the one after it
        bool inside_after = false, knows_next = false;
    };

    double together(double t) const {
        const Vec3 p = ray_.at(t);
        return kTogether * (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + norm(p - ray_.origin)) /
               speed_;
    }
    bool leaves(const RayPiece& p, const SurfaceHit& hit) const {
        return (dot(hit.normal, ray_.direction) > 0) != p.is_cavity;
    }
    SurfaceHit next_hit(std::int32_t piece, double from) const {
        return pieces_[static_cast<std::size_t>(piece)].first_hit(ray_, {from, RaySpan{}.to});
    }
    double least() const {
        double t = RaySpan{}.to;
        for (const Crossing& c : crossings_) t = std::min(t, c.hit.t);
        return t;
    }

    // Is the ray within the piece after the crossing? Between a mesh's faces the winding number says.
    void look_ahead(Crossing& c) const {
        const RayPiece& p = pieces_[static_cast<std::size_t>(c.piece)];
        if (p.target->tells_sides()) {
            c.inside_after = !leaves(p, c.hit);
            return;
        }
        c.next = next_hit(c.piece, c.hit.t + together(c.hit.t));
        c.knows_next = true;
        c.inside_after = c.next.found() && p.contains(ray_.at(c.hit.t + (c.next.t - c.hit.t) / 2));
    }

    // All crossings up to t; the first that turns the result is `found`.
    void cross_until(double t, bool before, SurfaceHit& found) {
        for (std::size_t i = 0; i < crossings_.size();) {
            Crossing& c = crossings_[i];
            if (!(c.hit.t <= t)) {
                ++i;
                continue;
            }
            const bool now = within_piece(c.piece);
            if (now != c.inside_after) turn(c.piece, c.inside_after ? 1 : -1);
            if ((inside_.back() != 0) != before && !found.found()) found = c.hit;
            c.hit = c.knows_next ? c.next : next_hit(c.piece, c.hit.t + together(c.hit.t));
            if (c.hit.found()) {
                look_ahead(c);
            } else {
                c = crossings_.back();
                crossings_.pop_back();
            }
        }
    }

    bool within_piece(std::int32_t piece) const {
        return std::find(entered_.begin(), entered_.end(), piece) != entered_.end();
    }

    void turn(std::int32_t piece, int by) {
        if (by > 0)
            entered_.push_back(piece);
        else
            std::erase(entered_, piece);
        within_[static_cast<std::size_t>(all_.slot_of_[static_cast<std::size_t>(piece)])] += by;
        std::int32_t node = all_.node_of_[static_cast<std::size_t>(piece)];
        for (bool now = in_operand(node); node >= 0; now = node >= 0 && in_operation(node)) {
            std::uint8_t& was = inside_[static_cast<std::size_t>(node)];
            if ((was != 0) == now) return;
            was = now ? 1 : 0;
            node = all_.nodes_[static_cast<std::size_t>(node)].parent;
        }
    }

    // Within an object and none of its cavities; the last ones first, as ModelField takes them out.
    bool in_operand(std::int32_t node) {
        const CombinedPieces::Node& n = all_.nodes_[static_cast<std::size_t>(node)];
        scratch_.clear();
        for (std::int32_t i = n.first; i < n.last; ++i)
            scratch_.push_back(within_[static_cast<std::size_t>(i)] > 0 ? 1 : 0);
        for (std::int32_t i = n.last; i-- > n.first;) {
            const std::int32_t outer = all_.outer_[static_cast<std::size_t>(i)];
            if (outer >= 0 && scratch_[static_cast<std::size_t>(i - n.first)] != 0)
                scratch_[static_cast<std::size_t>(outer - n.first)] = 0;
        }
        for (std::int32_t i = n.first; i < n.last; ++i)
            if (all_.outer_[static_cast<std::size_t>(i)] < 0 &&
                scratch_[static_cast<std::size_t>(i - n.first)] != 0)
                return true;
        return false;
    }

    bool in_operation(std::int32_t node) const {
        const CombinedPieces::Node& n = all_.nodes_[static_cast<std::size_t>(node)];
        const bool a = inside_[static_cast<std::size_t>(n.a)] != 0,
                   b = inside_[static_cast<std::size_t>(n.b)] != 0;
        return n.kind == Kind::unite ? a || b : n.kind == Kind::intersect ? a && b : a && !b;
    }

    const CombinedPieces& all_;
    std::span<const RayPiece> pieces_;
    Ray ray_;
    double speed_;
    std::vector<std::uint8_t> inside_;  // by node
    std::vector<std::int32_t> within_;  // by slot: copies that the ray is within
    std::vector<std::int32_t> entered_;
    std::vector<Crossing> crossings_;
    std::vector<std::uint8_t> scratch_;
};

SurfaceHit CombinedPieces::first_hit(std::span<const RayPiece> pieces, const BoxTree& boxes, const Ray& ray,
                                     const RaySpan& span) const {
    CombinedRay combined(*this, pieces, ray);
    // Beyond the span, too: where a piece is left tells that the ray begins within it.
    RaySpan all{span.from, RaySpan{}.to};
    boxes.walk(ray, all, [&](std::int32_t piece, RaySpan&) { combined.add(piece, span.from); });
    return combined.run(span.to);
}

std::vector<Box> CombinedPieces::cover(std::span<const RayPiece> pieces) const {
    return cover(pieces, static_cast<std::int32_t>(nodes_.size()) - 1);
}

std::vector<Box> CombinedPieces::cover(std::span<const RayPiece> pieces, std::int32_t node) const {
    const Node& n = nodes_[static_cast<std::size_t>(node)];
    std::vector<Box> all;
    if (n.kind == Kind::operand) {
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (node_of_[i] != node) continue;
            const std::vector<Box> boxes = pieces[i].cover();
            all.insert(all.end(), boxes.begin(), boxes.end());
        }
        return all;
    }
    all = cover(pieces, n.a);
    if (n.kind == Kind::subtract) return all;
    const std::vector<Box> others = cover(pieces, n.b);
    if (n.kind == Kind::unite) {
        all.insert(all.end(), others.begin(), others.end());
        return all;
    }
    Box other;
    for (const Box& box : others) other.grow(box);
    std::vector<Box> both;
    for (const Box& box : all) {
        const Box part{max(box.lo, other.lo), min(box.hi, other.hi)};
        if (part.lo.x <= part.hi.x && part.lo.y <= part.hi.y && part.lo.z <= part.hi.z) both.push_back(part);
    }
    return both;
}

}  // namespace pfgeom
