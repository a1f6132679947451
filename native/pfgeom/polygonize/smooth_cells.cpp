#include "pfgeom/polygonize/smooth_cells.h"

#include "pfgeom/polygonize/lattice.h"
#include "pfgeom/polygonize/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

constexpr std::size_t kKnown = 1 << 16;
constexpr double kWide = 0.5;         // cosine of normals in a cell that may hold more than one sheet
constexpr double kMostOff = 3.0 / 8;  // of the largest second difference, as of quadrics (tree_cells.cpp)

}  // namespace

const Jet& SmoothCells::jet(std::int32_t question, const Vec3& p, std::int32_t vertex) {
    if (known_.empty()) known_.resize(kKnown);
    const std::uint64_t key = static_cast<std::uint64_t>(vertex) << 16 ^ static_cast<std::uint64_t>(question);
    Known& known = known_[hash_key(key) & (kKnown - 1)];
    if (known.vertex != vertex || known.question != question) {
        Vec3 gradient;
        const double value = solid_.value(question, p, gradient);
        known = {vertex, question, {value, is_finite(gradient) ? normalized(gradient) : Vec3{}}};
    }
    return known.jet;
}

int SmoothCells::side(std::int32_t question, const std::array<Vec3, 4>& p,
                      const std::array<std::int32_t, 4>& vertex) {
    const bool high = jet(question, p[0], vertex[0]).value >= 0;
    for (std::size_t i = 1; i < 4; ++i)
        if ((jet(question, p[i], vertex[i]).value >= 0) != high) return 0;
    if (solid_.smooth(question).slope > 0) return side_by_slope(question, p, vertex);
    Box box;
    for (const Vec3& corner : p) box.grow(corner);
    const Interval range = solid_.smooth(question).field->range(box);
    return range.lo > 0 ? 1 : range.hi < 0 ? -1 : 0;
}

// From the corners' values alone, which are known: a distance to a mesh takes long to find.
int SmoothCells::side_by_slope(std::int32_t question, const std::array<Vec3, 4>& p,
                               const std::array<std::int32_t, 4>& vertex) {
    const double slope = solid_.smooth(question).slope * (1 + 1e-9);
    for (std::size_t i = 0; i < 4; ++i) {
        double reach = 0;
        for (const Vec3& other : p) reach = std::max(reach, squared_norm(other - p[i]));
        const double value = jet(question, p[i], vertex[i]).value;
        if (std::abs(value) > slope * std::sqrt(reach)) return value > 0 ? 1 : -1;
    }
    return 0;
}

double SmoothCells::deviation(std::int32_t question, const std::array<Vec3, 4>& p,
                              const std::array<std::int32_t, 4>& vertex) {
    double longest = 0, bend = 0, least_cosine = 1;
    bool high = false, low = false;
    for (const auto& [a, b] : kTetrahedronEdges) {
        const Vec3 e = p[static_cast<std::size_t>(b)] - p[static_cast<std::size_t>(a)];
        longest = std::max(longest, norm(e));
        const Jet ja = jet(question, p[static_cast<std::size_t>(a)], vertex[static_cast<std::size_t>(a)]);
        const Jet jb = jet(question, p[static_cast<std::size_t>(b)], vertex[static_cast<std::size_t>(b)]);
        least_cosine = std::min(least_cosine, dot(ja.gradient, jb.gradient));
        bend = std::max(bend, std::abs(dot(jb.gradient - ja.gradient, e)));
        high |= ja.value >= 0 || jb.value >= 0;
        low |= ja.value < 0 || jb.value < 0;
    }
    if (longest > solid_.smooth(question).cell) return std::numeric_limits<double>::infinity();
    if (!(least_cosine >= kWide)) return longest;
    return high && low ? std::min(longest, kMostOff * bend) : 0;
}

}  // namespace pfgeom
