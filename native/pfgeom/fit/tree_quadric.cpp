#include "pfgeom/fit/tree_quadric.h"

#include "pfgeom/base/reproducible.h"
#include "pfgeom/function/quadric_family.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pfgeom {
namespace {

constexpr double kRidge = 1e-11;
constexpr double kAligned = 0.9;    // CheckPoint::outwards
constexpr int kCoarsestShift = 11;  // of linear terms and of squares; coarser never won
// Scales span a little more than an octave: the units are powers of two.
constexpr double kLeastScale = 0.6, kScaleSpan = 1.0;

// Least squares within a family, prepared for rounding one integer after the other.
struct FamilySystem {
    std::size_t size = 0;
    Vector10 best{};  // at a mean gradient of one
    Matrix10 pull{};  // by how much integer i answers to the error of each one before it
};

Matrix10 restrict_to(const QuadricFamily& family, const Matrix10& full) {
    Matrix10 a{};
    for (std::size_t i = 0; i < family.size; ++i) {
        for (std::size_t j = 0; j < family.size; ++j) {
            for (std::size_t k = 0; k < 10; ++k) {
                if ((family.terms[i] >> k & 1U) == 0) continue;
                for (std::size_t l = 0; l < 10; ++l) {
                    if ((family.terms[j] >> l & 1U) != 0) a[i][j] += full[k][l];
                }
            }
        }
    }
    return a;
}

Vector10 restrict_to(const QuadricFamily& family, const Vector10& full) {
    Vector10 b{};
    for (std::size_t i = 0; i < family.size; ++i) {
        for (std::size_t k = 0; k < 10; ++k) b[i] += (family.terms[i] >> k & 1U) != 0 ? full[k] : 0;
    }
    return b;
}

double form(const Matrix10& a, const Vector10& x, std::size_t n) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) sum += x[i] * a[i][j] * x[j];
    }
    return sum;
}

double product(const Vector10& a, const Vector10& b, std::size_t n) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
    return sum;
}

Quadric spread(const QuadricFamily& family, const Vector10& x) {
    Quadric q;
    for (std::size_t i = 0; i < family.size; ++i) {
        for (std::size_t k = 0; k < 10; ++k) {
            if ((family.terms[i] >> k & 1U) != 0) q.c[k] = x[i];
        }
    }
    return q;
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
    FamilySearch(std::uint8_t index, const QuadricSystem& region, double normal_weight);

    bool serves(const std::vector<CheckPoint>& points) const;
    void run(std::vector<CheckPoint>& points, int resolution, int scales,
             std::optional<QuantisedQuadric>& best);

  private:
    void try_units(std::vector<CheckPoint>& points, int resolution, TreeQuadric units, int scales,
                   std::optional<QuantisedQuadric>& best);
    std::optional<double> round_integers(double scale, int resolution, TreeQuadric& q,
                                         double most_bits) const;
    bool faces_inwards(const Vector10& x) const;

    const QuadricFamily& family_;
    std::uint8_t index_;
    FamilySystem system_;
    Matrix10 gradients_{};
    Vector10 inwards_{};
};

FamilySearch::FamilySearch(std::uint8_t index, const QuadricSystem& region, double normal_weight)
    : family_(quadric_families()[index]), index_(index) {
    const std::size_t n = system_.size = family_.size;
    gradients_ = restrict_to(family_, region.gradients);
    inwards_ = restrict_to(family_, region.inwards);
    Matrix10 a = restrict_to(family_, region.values);
    Vector10 b{};
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) a[i][j] += normal_weight * gradients_[i][j];
        b[i] = normal_weight * inwards_[i];
        trace += a[i][i];
    }
    Matrix10 reversed{};  // so that the first integer comes last in elimination and is rounded first
    for (std::size_t i = 0; i < n; ++i) a[i][i] += kRidge * trace;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) reversed[n - 1 - i][n - 1 - j] = a[i][j];
    }
    system_.best = solve_factorised(factorise(a, n), b, n);
    const Matrix10 f = factorise(reversed, n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) system_.pull[i][j] = f[n - 1 - j][n - 1 - i];
    }
    const double slope = std::sqrt(std::max(form(gradients_, system_.best, n), 0.0));
    for (std::size_t i = 0; i < n; ++i) system_.best[i] = slope > 1e-3 ? system_.best[i] / slope : 0;
}

bool FamilySearch::serves(const std::vector<CheckPoint>& points) const {
    return faces_inwards(system_.best) && passes(spread(family_, system_.best), points);
}

// Mean gradient near one, and against the normals.
bool FamilySearch::faces_inwards(const Vector10& x) const {
    const double slope = std::sqrt(std::max(form(gradients_, x, family_.size), 0.0));
    return slope >= 0.4 && slope <= 1.8 && product(x, inwards_, family_.size) >= 0.5 * slope;
}

// Rounds one integer after the other, each to where least squares want it after the errors of those before
// it. Returns the bits, nothing if they become too many.
std::optional<double> FamilySearch::round_integers(double scale, int resolution, TreeQuadric& q,
                                                   double most_bits) const {
    double bits = head_bits(family_.kind);
    Vector10 error{};
    for (std::size_t i = 0; i < family_.size; ++i) {
        const int degree = family_.degree(static_cast<int>(i));
        const bool direction = family_.kind == FamilyKind::axis_plane && degree == 1;
        double target = scale * system_.best[i];
        for (std::size_t j = 0; j < i; ++j) target -= system_.pull[i][j] * error[j];
        int exponent = resolution - (degree >= 1 ? q.linear_shift : 0) - (degree == 2 ? q.square_shift : 0);
        if (direction) exponent = 0;
        const double n = std::floor(std::ldexp(target, exponent) + 0.5);
        if (std::abs(n) > kMostQuadricInteger) return {};
        q.n[i] = direction ? (target > 0 ? 1 : -1) : static_cast<std::int32_t>(n);
        error[i] = std::ldexp(static_cast<double>(q.n[i]), -exponent) - scale * system_.best[i];
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
        Vector10 x{};
        for (std::size_t i = 0; i < family_.size; ++i) {
            std::size_t k = 0;
            while ((family_.terms[i] >> k & 1U) == 0) ++k;
            x[i] = q.quadric.c[k];
        }
        if (!faces_inwards(x)) continue;
        const auto bad =
            std::ranges::find_if_not(points, [&](const CheckPoint& c) { return passes_point(q.quadric, c); });
        if (bad != points.end()) {
            std::rotate(points.begin(), bad, bad + 1);
        } else {
            best = {q, *bits};
        }
    }
}

void FamilySearch::run(std::vector<CheckPoint>& points, int resolution, int scales,
                       std::optional<QuantisedQuadric>& best) {
    const int linear = family_.has_linear_shift() ? kCoarsestShift : 0;
    const int square = family_.has_squares() ? kCoarsestShift : 0;
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
