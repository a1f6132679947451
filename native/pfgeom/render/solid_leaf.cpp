#include "pfgeom/render/solid_leaf.h"

#include "pfgeom/render/parabola.h"
#include "pfgeom/render/span_roots.h"

#include <algorithm>
#include <tuple>

namespace pfgeom {
namespace {

// Of the search for zeros, in the cube's units.
constexpr double kResolution = 1e-11;

struct Root {
    double t = 0;
    std::size_t live = 0;
};

}  // namespace

LeafAnswer LeafRay::ask_solid(const RaySpan& span) const {
    if (leaf_.nodes.size() == 1) return ask_alone(span);
    std::vector<Root> roots;
    std::vector<std::uint8_t> signs, scratch;
    for (std::size_t i = 0; i < leaf_.live.size(); ++i) {
        const bool high = search(i, span, [&](double t) {
            roots.push_back({t, i});
            return false;
        });
        signs.push_back(high ? 1 : 0);
    }
    std::sort(roots.begin(), roots.end(),
              [](const Root& a, const Root& b) { return std::tie(a.t, a.live) < std::tie(b.t, b.live); });
    const bool begins = is_inside(leaf_.nodes, signs, scratch);
    for (const Root& root : roots) {
        signs[root.live] ^= 1U;
        if (is_inside(leaf_.nodes, signs, scratch) == begins) continue;
        const Vec3 outwards = begins ? ray_.direction : -ray_.direction;
        return {begins, !begins, {root.t, outwards, -1, leaf_.live[root.live].function}};
    }
    return {begins, begins, {}};
}

// The common case: the leaf is one function.
LeafAnswer LeafRay::ask_alone(const RaySpan& span) const {
    LeafAnswer answer;
    const bool begins = search(0, span, [&](double t) {
        answer.hit.t = t;
        return true;
    });
    answer.begins_inside = begins;
    answer.ends_inside = begins != answer.hit.found();
    answer.hit.normal = begins ? ray_.direction : -ray_.direction;
    answer.hit.function = leaf_.live[0].function;
    return answer;
}

LeafAnswer LeafRay::ask_sheet(const RaySpan& span) const {
    LeafAnswer answer;
    std::vector<std::uint8_t> signs(leaf_.live.size(), 1), scratch;
    search(0, span, [&](double t) {
        for (std::size_t i = 1; i < signs.size(); ++i) signs[i] = value(i, t) >= 0 ? 1 : 0;
        if (!is_inside(leaf_.nodes, signs, scratch)) return false;
        answer.hit.t = t;
        answer.hit.function = leaf_.live[0].function;
        return true;
    });
    return answer;
}

double LeafRay::value(std::size_t i, double t) const {
    const LiveFunction& live = leaf_.live[i];
    return functions_[static_cast<std::size_t>(live.function)].value(ray_.at(t), live.in_cell.live);
}

// found(t) for the sign changes of one function, rising, until it returns true; returns whether the function
// is high at the beginning.
template <class Found>
bool LeafRay::search(std::size_t i, const RaySpan& span, Found found) const {
    const CellFunction& cell = leaf_.live[i].in_cell;
    if (cell.live.empty())
        return solve(functions_[static_cast<std::size_t>(leaf_.live[i].function)].base(), span, found);
    const double slope = dot(cell.linear.gradient, ray_.direction);
    const double offset = cell.linear.value + dot(cell.linear.gradient, ray_.origin - cell.centre);
    const double begin = offset + slope * span.from, end = offset + slope * span.to;
    if (std::min(begin, end) > cell.error || std::max(begin, end) < -cell.error) return begin > 0;
    // The function is within the error of this line, so only that part of the span counts in which the line
    // is within the error of zero.
    RaySpan part = span;
    if (std::abs(begin) > cell.error) part.from = (std::copysign(cell.error, begin) - offset) / slope;
    if (std::abs(end) > cell.error) part.to = (std::copysign(cell.error, end) - offset) / slope;
    part.from = std::clamp(part.from, span.from, span.to);
    part.to = std::clamp(part.to, part.from, span.to);
    const auto f = [&](double t) { return value(i, t); };
    SpanRoots roots(f, cell.bend * squared_speed_, kResolution / std::sqrt(squared_speed_), found);
    roots.run(part);
    return roots.from_value() >= 0;
}

// The same where the base alone is left.
template <class Found>
bool LeafRay::solve(const Quadric& quadric, const RaySpan& span, Found found) const {
    const Parabola parabola(quadric, ray_);
    std::array<double, 2> zeros{};
    const int count = parabola.roots(zeros);
    double first = span.to;
    bool done = false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        if (!(zeros[k] > span.from && zeros[k] < span.to)) continue;
        first = std::min(first, zeros[k]);
        done = done || found(zeros[k]);
    }
    return parabola.is_high(span.from + (first - span.from) / 2);
}

}  // namespace pfgeom
