#include "pfgeom/function/affine.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Entries below this leave room for products of all that a file may hold.
constexpr double kMostEntry = 0x1p60;
// Product of the stretches of a map and its inverse beyond which a shape is flat: values of functions then
// have some ten digits left.
constexpr double kMostFlat = 1e6;

std::array<Vec3, 3> columns_of(const std::array<Vec3, 3>& r) {
    return {{{r[0].x, r[1].x, r[2].x}, {r[0].y, r[1].y, r[2].y}, {r[0].z, r[1].z, r[2].z}}};
}

bool is_bounded(const Vec3& v) {
    return std::abs(v.x) <= kMostEntry && std::abs(v.y) <= kMostEntry && std::abs(v.z) <= kMostEntry;
}

}  // namespace

Affine affine_of(const Similarity& similarity) {
    Affine map;
    for (std::size_t i = 0; i < 3; ++i) map.rows[i] = similarity.rows[i] * similarity.scale;
    map.translation = similarity.translation;
    return map;
}

Affine affine_of(const Frame& frame) {
    const double half = frame.half();
    return {{{{half, 0, 0}, {0, half, 0}, {0, 0, half}}}, frame.centre()};
}

std::optional<Similarity> similarity_of(const Affine& map) {
    constexpr double kRounding = 1e-9;
    const double square =
        (squared_norm(map.rows[0]) + squared_norm(map.rows[1]) + squared_norm(map.rows[2])) / 3;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k <= i; ++k) {
            const double expected = i == k ? square : 0;
            if (!(std::abs(dot(map.rows[i], map.rows[k]) - expected) <= kRounding * square))
                return std::nullopt;
        }
    }
    Similarity similarity;
    similarity.scale = std::sqrt(square);
    for (std::size_t i = 0; i < 3; ++i) similarity.rows[i] = map.rows[i] / similarity.scale;
    similarity.translation = map.translation;
    return similarity;
}

Affine composed(const Affine& outer, const Affine& inner) {
    Affine both;
    for (std::size_t i = 0; i < 3; ++i) both.rows[i] = inner.pull(outer.rows[i]);
    both.translation = outer.apply(inner.translation);
    return both;
}

Affine inverse_of(const Affine& map) {
    const auto& r = map.rows;
    const Vec3 a = cross(r[1], r[2]), b = cross(r[2], r[0]), c = cross(r[0], r[1]);
    const double determinant = dot(r[0], a);
    Affine inverse;
    inverse.rows = columns_of({a / determinant, b / determinant, c / determinant});
    inverse.translation = Vec3{} - inverse.turn(map.translation);
    return inverse;
}

double most_stretch(const Affine& map) {
    const std::array<Vec3, 3> c = columns_of(map.rows);
    double most = 0;
    for (const Vec3& column : c)
        most = std::max(
            most, (std::abs(dot(column, c[0])) + std::abs(dot(column, c[1]))) + std::abs(dot(column, c[2])));
    return std::sqrt(most);
}

std::string find_flaw(const Affine& map) {
    if (!std::all_of(map.rows.begin(), map.rows.end(), is_bounded) || !is_bounded(map.translation))
        return "a transform's numbers are not finite or beyond 2^60";
    const double volume = std::abs(dot(map.rows[0], cross(map.rows[1], map.rows[2])));
    if (!(volume > 0 && most_stretch(map) * most_stretch(inverse_of(map)) <= kMostFlat))
        return "a transform flattens space and cannot be inverted";
    if (!(most_stretch(map) >= 1 / kMostEntry)) return "a transform's scale is below 2^-60";
    return {};
}

// With p = M x + t: the squares' matrix becomes Mᵀ A M, and so on.
Quadric substituted(const Quadric& q, const Affine& map) {
    const auto& c = q.c;
    const auto squares = [&c](const Vec3& a, const Vec3& b) {  // aᵀ A b of the symmetric matrix
        return (c[0] * a.x * b.x + c[1] * a.y * b.y + c[2] * a.z * b.z) +
               0.5 * (c[3] * (a.x * b.y + a.y * b.x) + c[4] * (a.x * b.z + a.z * b.x) +
                      c[5] * (a.y * b.z + a.z * b.y));
    };
    const std::array<Vec3, 3> m = columns_of(map.rows);
    const Vec3 slope = map.pull(q.gradient(map.translation));
    return {{squares(m[0], m[0]), squares(m[1], m[1]), squares(m[2], m[2]), 2 * squares(m[0], m[1]),
             2 * squares(m[0], m[2]), 2 * squares(m[1], m[2]), slope.x, slope.y, slope.z,
             q.value(map.translation)}};
}

}  // namespace pfgeom
