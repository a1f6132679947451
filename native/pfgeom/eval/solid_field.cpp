#include "pfgeom/eval/solid_field.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr double kEverywhere = 1e30;  // the value of `inside`; its negative that of `outside`

using Kind = SetNode::Kind;

}  // namespace

SolidField::SolidField(const Model& model, const Solid& solid) : nodes_(solid.nodes) {
    field_of_.assign(model.functions.size(), -1);
    const auto need = [&](std::int32_t function) {
        std::int32_t& row = field_of_[static_cast<std::size_t>(function)];
        if (row >= 0) return;
        row = static_cast<std::int32_t>(fields_.size());
        fields_.emplace_back(model.functions[static_cast<std::size_t>(function)]);
    };
    for (const SetNode& node : nodes_) {
        if (node.kind == Kind::function) need(node.a);
        if (node.kind == Kind::decide) need(node.f);
    }
}

const FunctionField& SolidField::field(std::int32_t function) const {
    return fields_[static_cast<std::size_t>(field_of_[static_cast<std::size_t>(function)])];
}

double SolidField::value(const Vec3& p, std::int32_t index) const {
    const SetNode& node = nodes_[static_cast<std::size_t>(index)];
    switch (node.kind) {
        case Kind::function:
            return field(node.a).value(p);
        case Kind::unite:
            return std::max(value(p, node.a), value(p, node.b));
        case Kind::intersect:
            return std::min(value(p, node.a), value(p, node.b));
        case Kind::complement:
            return -value(p, node.a);
        case Kind::decide:
            return value(p, field(node.f).value(p) >= 0 ? node.a : node.b);
        case Kind::inside:
            return kEverywhere;
        case Kind::outside:
            break;
    }
    return -kEverywhere;
}

Jet SolidField::jet(const Vec3& p, std::int32_t index) const {
    const SetNode& node = nodes_[static_cast<std::size_t>(index)];
    switch (node.kind) {
        case Kind::function:
            return field(node.a).jet(p);
        case Kind::unite:
        case Kind::intersect: {
            const Jet a = jet(p, node.a), b = jet(p, node.b);
            return (a.value >= b.value) == (node.kind == Kind::unite) ? a : b;
        }
        case Kind::complement: {
            const Jet a = jet(p, node.a);
            return {-a.value, -a.gradient};
        }
        case Kind::decide:
            return jet(p, field(node.f).value(p) >= 0 ? node.a : node.b);
        case Kind::inside:
            return {kEverywhere, {}};
        case Kind::outside:
            break;
    }
    return {-kEverywhere, {}};
}

Interval SolidField::range(const Box& box, std::int32_t index) const {
    const SetNode& node = nodes_[static_cast<std::size_t>(index)];
    const auto both = [&] { return std::pair(range(box, node.a), range(box, node.b)); };
    switch (node.kind) {
        case Kind::function:
            return field(node.a).range(box);
        case Kind::unite: {
            const auto [a, b] = both();
            return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
        }
        case Kind::intersect: {
            const auto [a, b] = both();
            return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
        }
        case Kind::complement: {
            const Interval a = range(box, node.a);
            return {-a.hi, -a.lo};
        }
        case Kind::decide: {
            const Interval side = field(node.f).range(box);
            if (side.lo >= 0) return range(box, node.a);
            if (side.hi < 0) return range(box, node.b);
            const auto [a, b] = both();
            return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
        }
        case Kind::inside:
            return {kEverywhere, kEverywhere};
        case Kind::outside:
            break;
    }
    return {-kEverywhere, -kEverywhere};
}

double SolidField::value(const Vec3& p) const {
    return nodes_.empty() ? -kEverywhere : value(p, root());
}

double SolidField::value_and_gradient(const Vec3& p, Vec3& gradient) const {
    const Jet j = nodes_.empty() ? Jet{-kEverywhere, {}} : jet(p, root());
    gradient = j.gradient;
    return j.value;
}

Interval SolidField::range(const Box& box) const {
    return nodes_.empty() ? Interval{-kEverywhere, -kEverywhere} : range(box, root());
}

}  // namespace pfgeom
