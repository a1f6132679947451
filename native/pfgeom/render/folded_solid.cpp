#include "pfgeom/render/folded_solid.h"

#include <utility>

namespace pfgeom {
namespace {

using Kind = SetNode::Kind;

class Folding {
  public:
    Folding(std::span<const SetNode> nodes, std::span<const KnownSign> signs)
        : nodes_(nodes), signs_(signs) {}

    std::vector<SetNode> run() {
        for (const SetNode& node : nodes_) now_.push_back(fold(node));
        if (now_.back() == kInside) return {{Kind::inside, -1, -1, -1}};
        if (now_.back() == kOutside) return {{Kind::outside, -1, -1, -1}};
        return reachable(now_.back());
    }

  private:
    static constexpr std::int32_t kInside = -1, kOutside = -2;  // else: a row of folded_

    std::int32_t now(std::int32_t node) const { return now_[static_cast<std::size_t>(node)]; }
    KnownSign sign(std::int32_t function) const { return signs_[static_cast<std::size_t>(function)]; }
    std::int32_t add(const SetNode& node) {
        folded_.push_back(node);
        return static_cast<std::int32_t>(folded_.size()) - 1;
    }

    std::int32_t fold(const SetNode& node) {
        switch (node.kind) {
            case Kind::function:
                if (sign(node.a) == KnownSign::unknown) return add(node);
                return sign(node.a) == KnownSign::inside ? kInside : kOutside;
            case Kind::unite:
                return fold_pair(Kind::unite, now(node.a), now(node.b), kInside, kOutside);
            case Kind::intersect:
                return fold_pair(Kind::intersect, now(node.a), now(node.b), kOutside, kInside);
            case Kind::complement:
                if (now(node.a) >= 0) return add({Kind::complement, now(node.a), -1, -1});
                return now(node.a) == kInside ? kOutside : kInside;
            case Kind::decide:
                return fold_decision(node);
            case Kind::inside:
                return kInside;
            case Kind::outside:
                break;
        }
        return kOutside;
    }

    std::int32_t fold_pair(Kind kind, std::int32_t a, std::int32_t b, std::int32_t wins,
                           std::int32_t yields) {
        if (a == wins || b == wins) return wins;
        if (a == yields || a == b) return b;
        if (b == yields) return a;
        return add({kind, a, b, -1});
    }

    std::int32_t fold_decision(const SetNode& node) {
        const std::int32_t a = now(node.a), b = now(node.b);
        if (sign(node.f) != KnownSign::unknown) return sign(node.f) == KnownSign::inside ? a : b;
        if (a == b) return a;
        return add({Kind::decide, as_node(a), as_node(b), node.f});
    }

    std::int32_t as_node(std::int32_t known) {
        if (known >= 0) return known;
        return add({known == kInside ? Kind::inside : Kind::outside, -1, -1, -1});
    }

    std::vector<SetNode> reachable(std::int32_t root) const {
        std::vector<std::int32_t> place(folded_.size(), -1);  // 0: is needed; then its row
        place[static_cast<std::size_t>(root)] = 0;
        for (std::size_t i = folded_.size(); i-- > 0;) {
            if (place[i] < 0 || folded_[i].kind == Kind::function) continue;
            for (const std::int32_t child : {folded_[i].a, folded_[i].b}) {
                if (child >= 0) place[static_cast<std::size_t>(child)] = 0;
            }
        }
        std::vector<SetNode> left;
        for (std::size_t i = 0; i < folded_.size(); ++i) {
            if (place[i] < 0) continue;
            place[i] = static_cast<std::int32_t>(left.size());
            SetNode node = folded_[i];
            if (node.kind != Kind::function) {
                if (node.a >= 0) node.a = place[static_cast<std::size_t>(node.a)];
                if (node.b >= 0) node.b = place[static_cast<std::size_t>(node.b)];
            }
            left.push_back(node);
        }
        return left;
    }

    std::span<const SetNode> nodes_;
    std::span<const KnownSign> signs_;
    std::vector<std::int32_t> now_;  // what became of each node
    std::vector<SetNode> folded_;
};

bool value_of(const SetNode& node, std::span<const std::uint8_t> signs,
              const std::vector<std::uint8_t>& values) {
    const auto child = [&](std::int32_t i) { return values[static_cast<std::size_t>(i)] != 0; };
    switch (node.kind) {
        case Kind::function:
            return signs[static_cast<std::size_t>(node.a)] != 0;
        case Kind::unite:
            return child(node.a) || child(node.b);
        case Kind::intersect:
            return child(node.a) && child(node.b);
        case Kind::complement:
            return !child(node.a);
        case Kind::decide:
            return child(signs[static_cast<std::size_t>(node.f)] != 0 ? node.a : node.b);
        case Kind::inside:
            return true;
        case Kind::outside:
            break;
    }
    return false;
}

}  // namespace

std::vector<SetNode> fold(std::span<const SetNode> nodes, std::span<const KnownSign> signs) {
    return Folding(nodes, signs).run();
}

bool is_inside(std::span<const SetNode> nodes, std::span<const std::uint8_t> signs,
               std::vector<std::uint8_t>& scratch) {
    scratch.clear();
    for (const SetNode& node : nodes) scratch.push_back(value_of(node, signs, scratch) ? 1 : 0);
    return scratch.back() != 0;
}

}  // namespace pfgeom
