// Source: Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985. Departure: the quaternion is
// scaled so that its largest component is an integer, which needs no root, and the other three are rounded:
// a cube's face instead of "smallest three", where at the same largest error a turn has 1.5 bits more.
#include "pfgeom/function/placement.h"

#include "pfgeom/function/frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfgeom {
namespace {

// Four times a component's square and products, from the entries of the matrix: the row of the largest
// component is the quaternion times a number that is not small.
std::array<double, 4> quaternion_of(const std::array<Vec3, 3>& m) {
    const double x = m[0].x, y = m[1].y, z = m[2].z;
    const std::array<double, 4> squares{1 + x + y + z, 1 + x - y - z, 1 - x + y - z, 1 - x - y + z};
    const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
    const double yz = m[2].y + m[1].z, zx = m[0].z + m[2].x, xy = m[1].x + m[0].y;
    const double wx = m[2].y - m[1].z, wy = m[0].z - m[2].x, wz = m[1].x - m[0].y;
    if (largest == 0) return {squares[0], wx, wy, wz};
    if (largest == 1) return {wx, squares[1], xy, zx};
    if (largest == 2) return {wy, xy, squares[2], yz};
    return {wz, zx, yz, squares[3]};
}

std::size_t largest_of(const std::array<std::int32_t, 4>& turn) {
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 4; ++i) {
        if (std::abs(turn[i]) > std::abs(turn[largest])) largest = i;
    }
    return largest;
}

// Common divisors of the steps and of all that is counted in them.
std::int32_t divisor_of_turns(const Placements& p) {
    std::int32_t divisor = p.turn_steps;
    for (const Placement& placement : p.list) {
        for (const std::int32_t component : placement.turn) divisor = std::gcd(divisor, component);
    }
    return divisor;
}
std::int32_t divisor_of_scales(const Placements& p) {
    std::int32_t divisor = p.scale_steps;
    for (const Placement& placement : p.list) divisor = std::gcd(divisor, placement.scale);
    return divisor;
}

std::int32_t least_place(const Placements& p, std::size_t axis) {
    std::int32_t least = p.list.front().place[axis];
    for (const Placement& placement : p.list) least = std::min(least, placement.place[axis]);
    return least;
}

bool comes_before(const Placement& a, const Placement& b) {
    return a.place[0] < b.place[0];
}

bool in_range(const Placement& p, const Placements& of) {
    const auto too_large = [](std::int32_t n) {
        return n < -Placements::kMostSteps || n > Placements::kMostSteps;
    };
    const auto outside = [](std::int32_t place) { return place < 0 || place > Placements::kMostPlace; };
    return std::none_of(p.turn.begin(), p.turn.end(), too_large) &&
           p.turn[largest_of(p.turn)] == of.turn_steps && p.scale >= 1 && p.scale <= Placements::kMostScale &&
           std::none_of(p.place.begin(), p.place.end(), outside);
}

}  // namespace

Similarity composed(const Similarity& outer, const Similarity& inner) {
    Similarity s;
    s.scale = outer.scale * inner.scale;
    for (std::size_t i = 0; i < 3; ++i) s.rows[i] = inner.turn_back(outer.rows[i]);
    s.translation = outer.apply(inner.translation);
    return s;
}

Similarity inverse_of(const Similarity& s) {
    Similarity inverse;
    inverse.scale = 1 / s.scale;
    const auto& r = s.rows;
    inverse.rows = {{{r[0].x, r[1].x, r[2].x}, {r[0].y, r[1].y, r[2].y}, {r[0].z, r[1].z, r[2].z}}};
    inverse.translation = -inverse.apply(s.translation);
    return inverse;
}

std::array<std::int32_t, 4> quantise_turn(const std::array<Vec3, 3>& rows, std::int32_t steps) {
    const std::array<double, 4> q = quaternion_of(rows);
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 4; ++i) {
        if (std::abs(q[i]) > std::abs(q[largest])) largest = i;
    }
    std::array<std::int32_t, 4> turn{};
    for (std::size_t i = 0; i < 4; ++i)
        turn[i] = static_cast<std::int32_t>(std::floor(q[i] / q[largest] * steps + 0.5));
    // Of equal magnitudes the first is the positive one.
    if (turn[largest_of(turn)] < 0) {
        for (std::int32_t& component : turn) component = -component;
    }
    return turn;
}

// Of integers below 2^26 all products and sums are exact.
std::array<Vec3, 3> rotation_of(const std::array<double, 4>& turn) {
    const auto [w, x, y, z] = turn;
    const double n = (w * w + x * x) + (y * y + z * z);
    return {{{((w * w + x * x) - (y * y + z * z)) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
             {2 * (x * y + w * z) / n, ((w * w + y * y) - (x * x + z * z)) / n, 2 * (y * z - w * x) / n},
             {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, ((w * w + z * z) - (x * x + y * y)) / n}}};
}

Similarity Placements::similarity(std::size_t i, const Vec3& centre) const {
    const Placement& p = list[i];
    Similarity s;
    s.scale = static_cast<double>(p.scale) / scale_steps;
    s.rows = rotation_of({static_cast<double>(p.turn[0]), static_cast<double>(p.turn[1]),
                          static_cast<double>(p.turn[2]), static_cast<double>(p.turn[3])});
    if (p.mirrored) {
        for (Vec3& row : s.rows) row.x = -row.x;
    }
    const double step = exp2_eighths(step_code);
    const auto at = [&](std::size_t axis) {
        return static_cast<double>(origin[axis] + p.place[axis]) * step;
    };
    s.translation = Vec3{at(0), at(1), at(2)} - s.apply(centre);
    return s;
}

void normalise(Placements& p) {
    if (p.empty()) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int32_t least = least_place(p, axis);
        p.origin[axis] += least;
        for (Placement& placement : p.list) placement.place[axis] -= least;
    }
    const std::int32_t turn = divisor_of_turns(p), scale = divisor_of_scales(p);
    p.turn_steps /= turn;
    p.scale_steps /= scale;
    for (Placement& placement : p.list) {
        for (std::int32_t& component : placement.turn) component /= turn;
        placement.scale /= scale;
    }
    std::stable_sort(p.list.begin(), p.list.end(), comes_before);
}

std::string find_flaw(const Placements& p) {
    if (p.empty()) return p == Placements{} ? "" : "there are steps but no placements";
    const auto is_steps = [](std::int32_t n) { return n >= 1 && n <= Placements::kMostSteps; };
    if (!is_steps(p.turn_steps) || !is_steps(p.scale_steps)) return "a placement's steps are out of range";
    if (p.step_code < Frame::kMinScale || p.step_code > Frame::kMaxScale)
        return "the step of the places is out of range";
    const auto outside = [](std::int64_t o) { return o < -Frame::kMaxOffset || o > Frame::kMaxOffset; };
    if (std::any_of(p.origin.begin(), p.origin.end(), outside)) return "the origin is out of range";
    if (!std::all_of(p.list.begin(), p.list.end(), [&p](const Placement& q) { return in_range(q, p); }))
        return "a placement is out of range";
    if (!std::is_sorted(p.list.begin(), p.list.end(), comes_before)) return "placements are not in order";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (least_place(p, axis) != 0) return "no placement is at the origin";
    }
    if (divisor_of_turns(p) != 1 || divisor_of_scales(p) != 1)
        return "the steps of the placements have a common divisor";
    return {};
}

}  // namespace pfgeom
