#include "pfgeom/segment/power_sums.h"

#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

PowerSums sums_of(const TriangleMesh& mesh) {
    PowerSums sums;
    for (const auto& [a, b, c] : mesh.faces)
        sums.add_triangle(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    return sums;
}

Vector10 monomials(const Vec3& p) {
    return {p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.x * p.z, p.y * p.z, p.x, p.y, p.z, 1};
}

TEST(Cholesky, SolvesADefiniteSystem) {
    Matrix10 a{};
    for (std::size_t i = 0; i < 10; ++i) {
        for (std::size_t j = 0; j < 10; ++j)
            a[i][j] = i == j ? 4 + static_cast<double>(i) : 1.0 / static_cast<double>(1 + i + j);
    }
    const Vector10 x{1, -2, 3, 0, 0.5, 7, -1, 2, 2, 1};
    Vector10 b{};
    for (std::size_t i = 0; i < 10; ++i) {
        for (std::size_t j = 0; j < 10; ++j) b[i] += a[i][j] * x[j];
    }
    const Vector10 solved = solve_factorised(factorise(a), b);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(solved[i], x[i], 1e-12);
}

TEST(Cholesky, LeavesUndeterminedComponentsAtZero) {
    const Vector10 solved = solve_factorised(factorise(Matrix10{}), {1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    EXPECT_EQ(solved, Vector10{});
}

TEST(PowerSums, HoldTheSystemsOfTheirPoints) {
    const Vec3 p{0.3, -0.7, 0.2}, n{0, 0.6, 0.8};
    PowerSums sums;
    sums.add(p, n, 2.5);
    const Vector10 m = monomials(p);
    const double h = 1e-6;
    for (std::size_t i = 0; i < 10; ++i) {
        const auto slope = [&](std::size_t k, int axis) {
            Vec3 q = p;
            q[axis] += h;
            return (monomials(q)[k] - m[k]) / h;
        };
        double inwards = 0;
        for (int d = 0; d < 3; ++d) inwards -= slope(i, d) * n[d];
        EXPECT_NEAR(sums.system().inwards[i], inwards, 1e-5);
        for (std::size_t j = 0; j < 10; ++j) {
            double product = 0;
            for (int d = 0; d < 3; ++d) product += slope(i, d) * slope(j, d);
            EXPECT_NEAR(sums.system().values[i][j], m[i] * m[j], 1e-14);
            EXPECT_NEAR(sums.system().gradients[i][j], product, 1e-5);
        }
    }
}

TEST(PowerSums, OfPartsAddUpToTheWhole) {
    const TriangleMesh mesh = shapes::ellipsoid({0.9, 0.5, 0.3});
    PowerSums whole = sums_of(mesh), first, second;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const auto& [a, b, c] = mesh.faces[f];
        (f % 3 == 0 ? first : second).add_triangle(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    }
    first += second;
    EXPECT_NEAR(first.weight(), surface_area(mesh), 1e-12);
    for (std::size_t i = 0; i < 10; ++i) {
        for (std::size_t j = 0; j < 10; ++j)
            EXPECT_NEAR(first.system().values[i][j], whole.system().values[i][j], 1e-13);
    }
}

TEST(PowerSums, FindTheQuadricOfATessellation) {
    const TriangleMesh mesh = shapes::translated(shapes::ellipsoid({0.7, 0.4, 0.3}, 5), {0.1, 0.05, -0.2});
    const Quadric q = sums_of(mesh).system().solve(1e-7);
    for (const Vec3& p : mesh.vertices) {
        EXPECT_LT(std::abs(q.value(p)) / norm(q.gradient(p)), 1e-3);
        EXPECT_LT(dot(q.gradient(p), p - Vec3{0.1, 0.05, -0.2}), 0) << "inside is positive";
    }
    const FitQuality quality = sums_of(mesh).system().quality(q);
    EXPECT_LT(quality.rms, 1e-3);
}

TEST(PowerSums, GoThroughPointsExactly) {
    const TriangleMesh mesh = shapes::ellipsoid({0.9, 0.5, 0.2}, 2);
    PowerSums sums;
    for (const Vec3& p : mesh.vertices) sums.add(p, normalized(p), 1);
    const Quadric q = sums.system().through_points();
    for (const Vec3& p : mesh.vertices) {
        EXPECT_LT(std::abs(q.value(p)) / norm(q.gradient(p)), 1e-9);
        EXPECT_LT(dot(q.gradient(p), p), 0);
    }
}

}  // namespace
}  // namespace pfgeom
