#include "pfgeom/fit/family_rounding.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

constexpr double kRidge = 1e-11;

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

}  // namespace

FamilyRounding::FamilyRounding(std::uint8_t family, const QuadricSystem& region, double normal_weight)
    : family_(quadric_families()[family]) {
    const std::size_t n = family_.size;
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
    best_ = solve_factorised(factorise(a, n), b, n);
    const Matrix10 f = factorise(reversed, n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) pull_[i][j] = f[n - 1 - j][n - 1 - i];
    }
    const double slope = std::sqrt(std::max(form(gradients_, best_, n), 0.0));
    for (std::size_t i = 0; i < n; ++i) best_[i] = slope > 1e-3 ? best_[i] / slope : 0;
}

Quadric FamilyRounding::best_quadric() const {
    return spread(family_, best_);
}

bool FamilyRounding::is_direction(std::size_t i) const {
    return family_.kind == FamilyKind::axis_plane && family_.degree(static_cast<int>(i)) == 1;
}

int FamilyRounding::exponent(const TreeQuadric& units, std::size_t i, int resolution) const {
    if (is_direction(i)) return 0;
    const int degree = family_.degree(static_cast<int>(i));
    return resolution - (degree >= 1 ? units.linear_shift : 0) - (degree == 2 ? units.square_shift : 0);
}

double FamilyRounding::wanted(std::size_t i, double scale, const Vector10& error) const {
    double target = scale * best_[i];
    for (std::size_t j = 0; j < i; ++j) target -= pull_[i][j] * error[j];
    return target;
}

Vector10 FamilyRounding::coefficients_of(const Quadric& quadric) const {
    Vector10 x{};
    for (std::size_t i = 0; i < family_.size; ++i) {
        std::size_t k = 0;
        while ((family_.terms[i] >> k & 1U) == 0) ++k;
        x[i] = quadric.c[k];
    }
    return x;
}

bool FamilyRounding::faces_inwards(const Quadric& quadric) const {
    const Vector10 x = coefficients_of(quadric);
    const double slope = std::sqrt(std::max(form(gradients_, x, family_.size), 0.0));
    return slope >= 0.4 && slope <= 1.8 && product(x, inwards_, family_.size) >= 0.5 * slope;
}

}  // namespace pfgeom
