#include "pfgeom/fit/tree_quadric.h"

#include "pfgeom/base/reproducible.h"
#include "pfgeom/fit/family_rounding.h"
#include "pfgeom/function/quadric_family.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pfgeom {
namespace {

constexpr double kAligned = 0.9;    // CheckPoint::outwards
constexpr int kCoarsestShift = 11;  // of linear terms and of squares; coarser never won
// Scales span a little more than an octave: the units are powers of two.
constexpr double kLeastScale = 0.6, kScaleSpan = 1.0;

bool passes_point(const Quadric& q, const CheckPoint& check) {
    if (check.kind != CheckPoint::Kind::near)
        return (q.value(check.point) >= 0) == (check.kind == CheckPoint::Kind::positive);
    if (!within(q, check.point, check.limit)) return false;
    if (check.outwards == Vec3{}) return true;
    const Vec3 g = q.gradient(check.point);
    return -dot(g, check.outwards) >= kAligned * norm(g);
}

double head_bits(FamilyKind kind) {
    return kind == FamilyKind::axis_plane ? 4 : kind == FamilyKind::plane ? 6.5 : 7.5;
}

// The search within one family.
class FamilySearch {
  public:
    FamilySearch(std::uint8_t index, const QuadricSystem& region, double normal_weight)
        : rounding_(index, region, normal_weight), index_(index) {}

    bool serves(const std::vector<CheckPoint>& points) const {
        const Quadric best = rounding_.best_quadric();
        return rounding_.faces_inwards(best) && passes(best, points);
    }
    void run(std::vector<CheckPoint>& points, int resolution, int scales,
             std::optional<QuantisedQuadric>& best);

  private:
    void try_units(std::vector<CheckPoint>& points, int resolution, TreeQuadric units, int scales,
                   std::optional<QuantisedQuadric>& best);
    std::optional<double> round_integers(double scale, int resolution, TreeQuadric& q,
                                         double most_bits) const;

    FamilyRounding rounding_;
    std::uint8_t index_;
};

// Rounds one integer after the other, each to where least squares want it after the errors of those before
// it. Returns the bits, nothing if they become too many.
std::optional<double> FamilySearch::round_integers(double scale, int resolution, TreeQuadric& q,
                                                   double most_bits) const {
    double bits = head_bits(rounding_.family().kind);
    Vector10 error{};
    for (std::size_t i = 0; i < rounding_.size(); ++i) {
        const bool direction = rounding_.is_direction(i);
        const double target = rounding_.wanted(i, scale, error);
        const int exponent = rounding_.exponent(q, i, resolution);
        const double n = std::floor(std::ldexp(target, exponent) + 0.5);
        if (std::abs(n) > kMostQuadricInteger) return {};
        q.n[i] = direction ? (target > 0 ? 1 : -1) : static_cast<std::int32_t>(n);
        error[i] = std::ldexp(static_cast<double>(q.n[i]), -exponent) - scale * rounding_.best()[i];
        bits += direction ? 1 : integer_bits(q.n[i]);
        if (bits >= most_bits) return {};
    }
    return bits;
}

void FamilySearch::try_units(std::vector<CheckPoint>& points, int resolution, TreeQuadric units, int scales,
                             std::optional<QuantisedQuadric>& best) {
    for (int s = 0; s < scales; ++s) {
        const double scale = scales > 1 ? kLeastScale + kScaleSpan * s / scales : 1;
        TreeQuadric q = units;
        const std::optional<double> bits = round_integers(scale, resolution, q, best ? best->bits : 1e9);
        if (!bits) continue;
        q.quadric = expand(q, resolution);
        if (rounding_.faces_inwards(q.quadric) && passes_in_turn(q.quadric, points)) best = {q, *bits};
    }
}

void FamilySearch::run(std::vector<CheckPoint>& points, int resolution, int scales,
                       std::optional<QuantisedQuadric>& best) {
    const int linear = rounding_.family().has_linear_shift() ? kCoarsestShift : 0;
    const int square = rounding_.family().has_squares() ? kCoarsestShift : 0;
    for (int l = linear; l >= 0; --l) {
        for (int s = square; s >= 0; --s) {
            TreeQuadric units;
            units.family = index_;
            units.linear_shift = static_cast<std::uint8_t>(l);
            units.square_shift = static_cast<std::uint8_t>(s);
            const double before = best ? best->bits : 1e9;
            try_units(points, resolution, units, linear > 0 ? scales : 1, best);
            if (best && best->bits < before) break;  // finer squares cost more
        }
    }
}

}  // namespace

bool passes(const Quadric& q, const std::vector<CheckPoint>& points) {
    return std::ranges::all_of(points, [&](const CheckPoint& c) { return passes_point(q, c); });
}

bool passes_in_turn(const Quadric& q, std::vector<CheckPoint>& points) {
    const auto bad =
        std::ranges::find_if_not(points, [&](const CheckPoint& c) { return passes_point(q, c); });
    if (bad == points.end()) return true;
    std::rotate(points.begin(), bad, bad + 1);
    return false;
}

double integer_bits(std::int32_t n) {
    // Exponential Golomb code with adaptive prefixes, and the sign; measured on the coder.
    const auto bits = [](std::int32_t v) { return v == 0 ? 1.0 : 2.5 + 1.3 * reproducible_log2(v + 1.0); };
    static const std::vector<double> small = [&] {
        std::vector<double> table(4096);
        for (std::size_t v = 0; v < table.size(); ++v) table[v] = bits(static_cast<std::int32_t>(v));
        return table;
    }();
    const auto v = static_cast<std::size_t>(std::abs(n));
    return v < small.size() ? small[v] : bits(std::abs(n));
}

std::optional<QuantisedQuadric> quantise(const PowerSums& sums, std::vector<CheckPoint>& points,
                                         int resolution, int scales, double normal_weight) {
    const QuadricSystem region = sums.system();
    std::optional<QuantisedQuadric> best;
    for (std::size_t f = 0; f < kQuadricFamilies; ++f) {
        FamilySearch search(static_cast<std::uint8_t>(f), region, normal_weight);
        if (search.serves(points)) search.run(points, resolution, scales, best);
    }
    return best;
}

TreeQuadric round_finely(const Quadric& q, int resolution) {
    TreeQuadric fine;
    fine.family = kQuadricFamilies - 1;
    for (std::size_t i = 0; i < q.c.size(); ++i) {
        const double n = std::floor(std::ldexp(q.c[i], resolution) + 0.5);
        fine.n[i] =
            static_cast<std::int32_t>(std::clamp(n, -1.0 * kMostQuadricInteger, 1.0 * kMostQuadricInteger));
    }
    fine.quadric = expand(fine, resolution);
    return fine;
}

double estimated_bits(const TreeQuadric& q) {
    const QuadricFamily& family = quadric_families()[q.family];
    double bits = head_bits(family.kind);
    for (std::size_t i = 0; i < family.size; ++i)
        bits += family.kind == FamilyKind::axis_plane && i == 0 ? 1 : integer_bits(q.n[i]);
    return bits;
}

}  // namespace pfgeom
