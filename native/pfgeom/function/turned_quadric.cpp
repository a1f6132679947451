#include "pfgeom/function/turned_quadric.h"

#include "pfgeom/function/principal_axes.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

using Kind = QuadricKind;

// Ten coefficients of 53 bits leave errors of some 1e-15 in what is computed here.
constexpr double kZero = 1e-12;

// One of the squares that are not zero, with its axis.
struct Square {
    Vec3 axis;
    double value = 0;
};

// The quadric about its centre: Σ squares + |gradient| t + constant, t along the gradient.
struct Centred {
    Vec3 centre;
    std::array<Square, 3> squares;  // the first `rank`
    std::size_t rank = 0;
    Vec3 gradient;  // of the axes without squares; zero or not
    double constant = 0;
};

Centred centred(const TurnedQuadric& q) {
    Centred result;
    result.centre = q.origin;
    double largest = 0, magnitude = std::abs(q.constant), slope = 0;
    for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, std::abs(q.squares[i]));
    result.constant = q.constant;
    for (std::size_t i = 0; i < 3; ++i) {
        const double s = q.squares[i], l = q.linear[i];
        slope = std::max(slope, std::abs(l));
        if (std::abs(s) <= kZero * largest) {
            result.gradient += l * q.axes[i];
            continue;
        }
        result.squares[result.rank++] = {q.axes[i], s};
        result.centre += q.axes[i] * (-l / (2 * s));
        result.constant -= l * l / (4 * s);
        magnitude += l * l / std::abs(4 * s);
    }
    if (norm(result.gradient) <= kZero * slope) result.gradient = {};
    if (std::abs(result.constant) <= kZero * magnitude) result.constant = 0;
    return result;
}

bool equal(const Square& a, const Square& b) {
    return std::abs(a.value - b.value) <= kZero * std::max(std::abs(a.value), std::abs(b.value));
}

QuadricShape along(Kind kind, const Vec3& centre, const Vec3& first, const Vec3& second,
                   const std::array<double, 3>& sizes = {}) {
    return {kind, centre, {first, second, cross(first, second)}, sizes};
}

Vec3 across(const Vec3& axis) {
    const Vec3 a{std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)};
    const Vec3 least = a.x <= a.y && a.x <= a.z ? Vec3{1, 0, 0} : a.y <= a.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return normalized(cross(axis, least));
}

// What one side of it looks like is what the other looks like, but for planes: away from the positive side.
QuadricShape plane_of(const Centred& q) {
    const double slope = norm(q.gradient);
    if (slope == 0) return {};
    const Vec3 up = q.gradient / slope;
    return along(Kind::plane, q.centre - up * (q.constant / slope), -up, across(up));
}

// Rank 1.
QuadricShape pair_or_parabola(const Centred& q) {
    const auto& [axis, s] = q.squares[0];
    const double slope = norm(q.gradient);
    if (slope > 0) {
        const Vec3 up = q.gradient / slope, opens = s > 0 ? -up : up;
        return along(Kind::parabolic_cylinder, q.centre - up * (q.constant / slope), cross(axis, opens),
                     opens, {slope / (4 * std::abs(s))});
    }
    const double squared = -q.constant / s;
    if (squared < 0) return {};
    if (squared == 0) return along(Kind::plane, q.centre, axis, across(axis));
    return along(Kind::parallel_planes, q.centre, axis, across(axis), {std::sqrt(squared)});
}

QuadricShape paraboloid_of(const Centred& q) {
    Square a = q.squares[0], b = q.squares[1];
    const double slope = norm(q.gradient);
    const Vec3 up = q.gradient / slope, vertex = q.centre - up * (q.constant / slope);
    const auto focal = [&](const Square& s) { return slope / (4 * std::abs(s.value)); };
    if (focal(a) < focal(b)) std::swap(a, b);
    const Kind kind = a.value * b.value < 0 ? Kind::hyperbolic_paraboloid
                      : equal(a, b)         ? Kind::circular_paraboloid
                                            : Kind::elliptic_paraboloid;
    return along(kind, vertex, a.value > 0 ? -up : up, a.axis, {focal(a), focal(b)});
}

// Rank 2 without a slope.
QuadricShape cylinder_of(const Centred& q) {
    Square a = q.squares[0], b = q.squares[1];
    const Vec3 axis = cross(a.axis, b.axis);
    const bool same = a.value * b.value > 0;
    if (q.constant == 0) {
        if (same) return along(Kind::line, q.centre, axis, a.axis);
        if (std::abs(a.value) > std::abs(b.value)) std::swap(a, b);
        return along(Kind::crossing_planes, q.centre, axis, a.axis, {std::sqrt(-a.value / b.value)});
    }
    const auto squared = [&](const Square& s) { return -q.constant / s.value; };
    if (same && squared(a) < 0) return {};
    if (squared(a) < squared(b)) std::swap(a, b);
    const std::array<double, 3> sizes{std::sqrt(std::abs(squared(a))), std::sqrt(std::abs(squared(b)))};
    const Kind kind = !same         ? Kind::hyperbolic_cylinder
                      : equal(a, b) ? Kind::circular_cylinder
                                    : Kind::elliptic_cylinder;
    return along(kind, q.centre, axis, a.axis, sizes);
}

// The one whose sign, or else whose value, is not that of the other two first; of those the smaller first.
std::array<Square, 3> odd_one_first(std::array<Square, 3> s) {
    std::ranges::stable_sort(s, {}, &Square::value);
    const bool two_below = s[0].value < 0 && s[1].value < 0 && s[2].value > 0;
    if (two_below || (s[0].value * s[2].value > 0 && equal(s[0], s[1]))) std::swap(s[0], s[2]);
    if (std::abs(s[1].value) > std::abs(s[2].value)) std::swap(s[1], s[2]);
    return s;
}

QuadricShape cone_of(const Centred& q) {
    const std::array<Square, 3> s = odd_one_first(q.squares);
    if (s[0].value * s[1].value > 0) return {.kind = Kind::point, .centre = q.centre};
    const auto tangent = [&](const Square& other) { return std::sqrt(-s[0].value / other.value); };
    const Kind kind = equal(s[1], s[2]) ? Kind::circular_cone : Kind::elliptic_cone;
    return along(kind, q.centre, s[0].axis, s[1].axis, {tangent(s[1]), tangent(s[2])});
}

// Rank 3 with a value at the centre.
QuadricShape ellipsoid_or_hyperboloid(const Centred& q) {
    std::array<Square, 3> s = q.squares;
    for (Square& square : s) square.value /= -q.constant;  // Σ value y² = 1
    s = odd_one_first(s);
    const bool round = equal(s[1], s[2]);
    const auto size = [](const Square& square) { return 1 / std::sqrt(std::abs(square.value)); };
    Kind kind = round ? Kind::spheroid : Kind::ellipsoid;
    if (s[0].value * s[1].value < 0) {
        if (s[0].value > 0)
            kind = round ? Kind::circular_two_sheets : Kind::two_sheets;
        else
            kind = round ? Kind::circular_one_sheet : Kind::one_sheet;
    } else if (s[0].value < 0) {
        return {};
    } else if (round && equal(s[0], s[1])) {
        kind = Kind::sphere;
    } else if (!round) {
        std::ranges::stable_sort(s, {}, &Square::value);  // semi-axes falling
    }
    return along(kind, q.centre, s[0].axis, s[1].axis, {size(s[0]), size(s[1]), size(s[2])});
}

}  // namespace

TurnedQuadric turned(const Quadric& q, const Vec3& origin) {
    const auto& c = q.c;
    const PrincipalAxes principal = principal_axes(
        {{{c[0], c[3] / 2, c[4] / 2}, {c[3] / 2, c[1], c[5] / 2}, {c[4] / 2, c[5] / 2, c[2]}}});
    const Vec3 gradient = q.gradient(origin);
    TurnedQuadric result{origin, principal.axes, principal.values, {}, q.value(origin)};
    for (std::size_t i = 0; i < 3; ++i) result.linear[i] = dot(gradient, principal.axes[i]);
    return result;
}

QuadricShape shape_of(const TurnedQuadric& quadric) {
    const Centred q = centred(quadric);
    if (q.rank == 0) return plane_of(q);
    if (q.rank == 1) return pair_or_parabola(q);
    if (q.rank == 2) return q.gradient == Vec3{} ? cylinder_of(q) : paraboloid_of(q);
    return q.constant == 0 ? cone_of(q) : ellipsoid_or_hyperboloid(q);
}

}  // namespace pfgeom
