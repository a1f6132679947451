#include "pfgeom/segment/power_sums.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pfgeom {
namespace {

using Exponents = std::array<int, 3>;

constexpr std::array<Exponents, 10> kMonomials{{{2, 0, 0},
                                                {0, 2, 0},
                                                {0, 0, 2},
                                                {1, 1, 0},
                                                {1, 0, 1},
                                                {0, 1, 1},
                                                {1, 0, 0},
                                                {0, 1, 0},
                                                {0, 0, 1},
                                                {0, 0, 0}}};

constexpr std::array<Exponents, 35> all_powers() {
    std::array<Exponents, 35> powers{};
    std::size_t n = 0;
    for (int degree = 0; degree <= 4; ++degree) {
        for (int i = degree; i >= 0; --i) {
            for (int j = degree - i; j >= 0; --j) powers[n++] = {i, j, degree - i - j};
        }
    }
    return powers;
}
constexpr std::array<Exponents, 35> kPowers = all_powers();

constexpr std::uint8_t index_of(const Exponents& e) {
    std::uint8_t i = 0;
    while (kPowers[i] != e) ++i;
    return i;
}

// Where the product of two monomials, or of their derivatives along one axis, is among the sums of powers.
struct Term {
    std::uint8_t row = 0, column = 0, power = 0, factor = 0;
};

constexpr std::size_t kValueTerms = 55;  // the lower triangle
constexpr std::array<Term, kValueTerms> value_terms() {
    std::array<Term, kValueTerms> terms{};
    std::size_t n = 0;
    for (std::uint8_t i = 0; i < 10; ++i) {
        for (std::uint8_t j = 0; j <= i; ++j) {
            Exponents sum{};
            for (std::size_t d = 0; d < 3; ++d) sum[d] = kMonomials[i][d] + kMonomials[j][d];
            terms[n++] = {i, j, index_of(sum), 1};
        }
    }
    return terms;
}

constexpr std::size_t kGradientTerms = 30;
constexpr std::array<Term, kGradientTerms> gradient_terms() {
    std::array<Term, kGradientTerms> terms{};
    std::size_t n = 0;
    for (std::uint8_t i = 0; i < 9; ++i) {
        for (std::uint8_t j = 0; j <= i; ++j) {
            for (std::size_t d = 0; d < 3; ++d) {
                const int factor = kMonomials[i][d] * kMonomials[j][d];
                if (factor == 0) continue;
                Exponents lower{};
                for (std::size_t k = 0; k < 3; ++k) lower[k] = kMonomials[i][k] + kMonomials[j][k];
                lower[d] -= 2;
                terms[n++] = {i, j, index_of(lower), static_cast<std::uint8_t>(factor)};
            }
        }
    }
    return terms;  // one term too many would not compile
}
constexpr auto kValues = value_terms();
constexpr auto kGradients = gradient_terms();
static_assert(kGradients.back().factor > 0);

// Keeps the system definite where the points leave it open; a thousandth of the smallest tolerance squared.
constexpr double kRidge = 1e-11;

double quadratic_form(const Matrix10& a, const Quadric& q) {
    double sum = 0;
    for (std::size_t i = 0; i < 10; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 10; ++j) row += a[i][j] * q.c[j];
        sum += q.c[i] * row;
    }
    return sum;
}

}  // namespace

void PowerSums::add(const Vec3& p, const Vec3& n, double weight) {
    std::array<std::array<double, 5>, 3> power{};
    for (std::size_t d = 0; d < 3; ++d) {
        power[d][0] = 1;
        for (std::size_t k = 1; k < 5; ++k) power[d][k] = power[d][k - 1] * p[static_cast<int>(d)];
    }
    for (std::size_t i = 0; i < powers_.size(); ++i) {
        const auto& [x, y, z] = kPowers[i];
        powers_[i] +=
            weight * (power[0][static_cast<std::size_t>(x)] * power[1][static_cast<std::size_t>(y)] *
                      power[2][static_cast<std::size_t>(z)]);
    }
    for (std::size_t d = 0; d < 3; ++d) {
        const double w = weight * n[static_cast<int>(d)];
        normals_[d][0] += w;
        for (int k = 0; k < 3; ++k) normals_[d][static_cast<std::size_t>(k) + 1] += w * p[k];
    }
}

void PowerSums::add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double weight) {
    const Vec3 twice = cross(b - a, c - a);
    const Vec3 n = normalized(twice);
    const double area = weight * norm(twice) / 2;
    for (const Vec3& p : {a, b, c}) add(p, n, area / 20);
    for (const Vec3& p : {(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5}) add(p, n, area * 2 / 15);
    add((a + b + c) / 3, n, area * 9 / 20);
}

PowerSums& PowerSums::operator+=(const PowerSums& other) {
    for (std::size_t i = 0; i < powers_.size(); ++i) powers_[i] += other.powers_[i];
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t k = 0; k < 4; ++k) normals_[d][k] += other.normals_[d][k];
    }
    return *this;
}

PowerSums& PowerSums::operator*=(double factor) {
    for (double& power : powers_) power *= factor;
    for (auto& of_axis : normals_) {
        for (double& n : of_axis) n *= factor;
    }
    return *this;
}

QuadricSystem PowerSums::system() const {
    QuadricSystem system;
    const double share = 1 / weight();
    for (const auto& [i, j, power, factor] : kValues)
        system.values[i][j] = system.values[j][i] = powers_[power] * share;
    for (const auto& [i, j, power, factor] : kGradients) {
        system.gradients[i][j] += factor * powers_[power] * share;
        system.gradients[j][i] = system.gradients[i][j];
    }
    const auto& n = normals_;
    system.inwards = {-2 * n[0][1],       -2 * n[1][2], -2 * n[2][3], -n[0][2] - n[1][1], -n[0][3] - n[2][1],
                      -n[1][3] - n[2][2], -n[0][0],     -n[1][0],     -n[2][0],           0};
    for (double& b : system.inwards) b *= share;
    return system;
}

Quadric QuadricSystem::solve(double normal_weight) const {
    Matrix10 a = values;
    Vector10 b = inwards;
    double trace = 0;
    for (std::size_t i = 0; i < 10; ++i) {
        for (std::size_t j = 0; j <= i; ++j) a[i][j] += normal_weight * gradients[i][j];
        b[i] *= normal_weight;
        trace += a[i][i];
    }
    for (std::size_t i = 0; i < 10; ++i) a[i][i] += kRidge * trace;
    return {solve_factorised(factorise(a), b)};
}

Quadric QuadricSystem::through_points() const {
    constexpr double kShift = 1e-15;  // of the trace: keeps the exact case solvable
    constexpr int kIterations = 4;    // of inverse iteration; the gap is wide when the answer is of use
    Matrix10 a = values;
    double trace = 0;
    for (std::size_t i = 0; i < 10; ++i) trace += a[i][i];
    for (std::size_t i = 0; i < 10; ++i) a[i][i] += kShift * trace;
    const Matrix10 f = factorise(a);
    Vector10 x = solve(1e-3).c;
    for (int k = 0; k < kIterations; ++k) {
        x = solve_factorised(f, x);
        double square = 0;
        for (const double c : x) square += c * c;
        for (double& c : x) c /= std::sqrt(square);
    }
    double along = 0;
    for (std::size_t i = 0; i < 10; ++i) along += x[i] * inwards[i];
    for (double& c : x) c = along < 0 ? -c : c;
    return {x};
}

FitQuality QuadricSystem::quality(const Quadric& q) const {
    constexpr double kLeastSlope = 1e-6;
    const double square = quadratic_form(values, q), slope = quadratic_form(gradients, q);
    double along = 0;
    for (std::size_t i = 0; i < 10; ++i) along += q.c[i] * inwards[i];
    return {std::sqrt(std::max(square, 0.0) / std::max(slope, kLeastSlope)), slope - 2 * along + 1};
}

}  // namespace pfgeom
