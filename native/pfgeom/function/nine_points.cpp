// Source: Vyatkin, Dolgovesov 2018, eq. 10-12: Q(P1) = ... = Q(P9) = 0, solved for the coefficients.
// Departures: the constant is an unknown like the other nine, since fixing it fails for a quadric through the
// origin; the system stands in a frame centred on the points; and it is solved by elimination with full
// pivoting instead of Cramer's rule, so that points that leave more than one quadric are seen for what they
// are.
#include "pfgeom/function/nine_points.h"

#include "pfgeom/base/box.h"
#include "pfgeom/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace pfgeom {
namespace {

constexpr std::size_t kPoints = 9, kTerms = 10;
constexpr double kMostExtent = 0x1p120, kLeastExtent = 0x1p-120;  // as a Frame's

// Of sets that leave more than one quadric (1,250 of each kind), rounding leaves pivots below 2e-15 (1 +
// distance from the origin / extent); the smallest of 20,000 sets in a cube is 2e-3, of 3,000 sets on a
// sphere's cap of 3 degrees 9e-9.
constexpr double kLeastPivot = 1e-12;

using Row = std::array<double, kTerms>;

Row terms(const Vec3& p) {
    return {p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.x * p.z, p.y * p.z, p.x, p.y, p.z, 1};
}

/// The homogeneous system of nine rows. The columns change places on the way to its null vector.
class NineRows {
  public:
    explicit NineRows(const std::array<Vec3, kPoints>& points) {
        for (std::size_t i = 0; i < kPoints; ++i) rows_[i] = terms(points[i]);
        for (std::size_t j = 0; j < kTerms; ++j) column_[j] = j;
    }

    /// To upper triangular form; the smallest pivot.
    double eliminate() {
        double least = 1;
        for (std::size_t k = 0; k < kPoints; ++k) {
            bring_pivot(k);
            const double pivot = rows_[k][k];
            least = std::min(least, std::abs(pivot));
            if (pivot == 0) break;
            for (std::size_t i = k + 1; i < kPoints; ++i) {
                const double factor = rows_[i][k] / pivot;
                for (std::size_t j = k; j < kTerms; ++j) rows_[i][j] -= factor * rows_[k][j];
            }
        }
        return least;
    }

    /// Of the eliminated system, with 1 for the unknown that was never a pivot.
    Quadric null_vector() const {
        Row x{};
        x[kPoints] = 1;
        for (std::size_t k = kPoints; k-- > 0;) {
            double sum = 0;
            for (std::size_t j = k + 1; j < kTerms; ++j) sum += rows_[k][j] * x[j];
            x[k] = -sum / rows_[k][k];
        }
        Quadric q;
        for (std::size_t j = 0; j < kTerms; ++j) q.c[column_[j]] = x[j];
        return q;
    }

  private:
    /// The largest entry of what is left, to row and column k.
    void bring_pivot(std::size_t k) {
        std::size_t row = k, column = k;
        for (std::size_t i = k; i < kPoints; ++i) {
            for (std::size_t j = k; j < kTerms; ++j) {
                if (std::abs(rows_[i][j]) > std::abs(rows_[row][column])) row = i, column = j;
            }
        }
        std::swap(rows_[k], rows_[row]);
        for (Row& r : rows_) std::swap(r[k], r[column]);
        std::swap(column_[k], column_[column]);
    }

    std::array<Row, kPoints> rows_{};
    std::array<std::size_t, kTerms> column_{};
};

Quadric normalized(Quadric q) {
    double sum = 0;
    for (const double c : q.c) sum += c * c;
    const double scale = (q.c[0] + q.c[1] + q.c[2] > 0 ? -1 : 1) / std::sqrt(sum);
    for (double& c : q.c) c *= scale;
    return q;
}

/// q((p - centre) / half) as a quadric in p.
Quadric moved(const Quadric& q, const Vec3& centre, double half) {
    const Vec3 origin = -centre / half;
    const Vec3 linear = q.gradient(origin) / half;
    Quadric result;
    for (std::size_t j = 0; j < 6; ++j) result.c[j] = q.c[j] / (half * half);
    result.c[6] = linear.x;
    result.c[7] = linear.y;
    result.c[8] = linear.z;
    result.c[9] = q.value(origin);
    return result;
}

}  // namespace

Quadric nine_points(std::span<const Vec3> points) {
    if (points.size() != kPoints)
        throw InvalidInput("a quadric takes nine points, not " + std::to_string(points.size()));
    Box box;
    for (std::size_t i = 0; i < kPoints; ++i) {
        if (!is_finite(points[i])) throw InvalidInput("points: row " + std::to_string(i) + " is not finite");
        box.grow(points[i]);
    }
    const Vec3 centre = box.centre(), size = box.extent();
    const double half = std::max({size.x, size.y, size.z}) / 2;
    const double far = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
    if (half == 0) throw InvalidInput("the nine points are one");
    if (!(half >= kLeastExtent && half <= kMostExtent && far <= kMostExtent))
        throw InvalidInput("the points' extent must lie between 2^-120 and 2^120");

    std::array<Vec3, kPoints> local;
    for (std::size_t i = 0; i < kPoints; ++i) local[i] = (points[i] - centre) / half;
    NineRows system(local);
    if (system.eliminate() < kLeastPivot * (1 + far / half))
        throw InvalidInput("more than one quadric goes through the nine points");
    return normalized(moved(system.null_vector(), centre, half));
}

}  // namespace pfgeom
