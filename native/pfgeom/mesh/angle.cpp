// Rational approximation of the arc tangent on [0, 0.66], relative error 1.8e-16.
// Source: Moshier, "Methods and programs for mathematical functions", 1989 (Cephes, atan.c).
// Departure: the argument is reduced as numerator and denominator, before the only division.
#include "pfgeom/mesh/angle.h"

#include <array>

namespace pfgeom {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTan3Pi8 = 2.41421356237309504880;

constexpr std::array<double, 5> kNumerator{-8.750608600031904122785e-1, -1.615753718733365076637e1,
                                           -7.500855792314704667340e1, -1.228866684490136173410e2,
                                           -6.485021904942025371773e1};
constexpr std::array<double, 6> kDenominator{1,
                                             2.485846490142306297962e1,
                                             1.650270098316988542046e2,
                                             4.328810604912902668951e2,
                                             4.853903996359136964868e2,
                                             1.945506571482613964425e2};

template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
    double sum = coefficients[0];
    for (std::size_t i = 1; i < N; ++i) sum = sum * x + coefficients[i];
    return sum;
}

double atan_small(double t) {
    const double z = t * t;
    return t + t * (z * polynomial(kNumerator, z) / polynomial(kDenominator, z));
}

// Of the angle of (x, y) in the first quadrant.
double first_quadrant(double y, double x) {
    if (y > kTan3Pi8 * x) return kPi / 2 - atan_small(x / y);
    if (y > 0.66 * x) return kPi / 4 + atan_small((y - x) / (y + x));
    return y > 0 ? atan_small(y / x) : 0;
}

}  // namespace

double reproducible_atan2(double y, double x) {
    const double angle = first_quadrant(y < 0 ? -y : y, x < 0 ? -x : x);
    const double upper = x < 0 ? kPi - angle : angle;
    return y < 0 ? -upper : upper;
}

double angle_between(const Vec3& a, const Vec3& b) {
    return reproducible_atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace pfgeom
