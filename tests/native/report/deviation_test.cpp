#include "pfgeom/report/deviation.h"

#include "pfgeom/base/random.h"
#include "pfgeom/report/piece.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

DeviationOptions only_bound(double certify_below = 0) {
    DeviationOptions options;
    options.samples = 0;
    options.certify_below = certify_below;
    return options;
}

TriangleMesh square(double half = 1, const Vec3& centre = {}) {
    return shapes::translated(
        {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}, {{0, 1, 2}, {0, 2, 3}}},
        centre);
}

// The square [-1,1]² without the square of half width `half` around `centre`.
TriangleMesh square_with_hole(double half, const Vec3& centre) {
    TriangleMesh mesh = shapes::joined(square(), square(half, centre));
    mesh.faces.clear();
    for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4;
        mesh.faces.push_back({i, j, 4 + j});
        mesh.faces.push_back({i, 4 + j, 4 + i});
    }
    return mesh;
}

TriangleMesh random_soup(Random& random, int faces, double size) {
    TriangleMesh mesh;
    const auto point = [&] {
        const double x = random.uniform(), y = random.uniform(), z = random.uniform();
        return Vec3{x, y, z};
    };
    for (int i = 0; i < faces; ++i) {
        const Vec3 centre = point();
        for (int k = 0; k < 3; ++k) mesh.vertices.push_back(centre + point() * size);
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

// Brute force without hierarchy or bounds: the largest distance at a grid of points on each face of `from`,
// no point of which is farther than `spacing` from the next.
struct BruteForce {
    double max = 0, spacing = 0;
};

BruteForce brute_force(const TriangleMesh& from, const TriangleMesh& to, int steps) {
    BruteForce truth;
    for (std::int32_t face = 0; face < static_cast<std::int32_t>(from.faces.size()); ++face) {
        const Corners p = corners_of(from, face);
        for (int i = 0; i < 3; ++i)
            truth.spacing = std::max(truth.spacing, norm(p[i] - p[(i + 1) % 3]) / steps);
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const Vec3 x = p[0] + (p[1] - p[0]) * (1.0 * i / steps) + (p[2] - p[0]) * (1.0 * j / steps);
                double least = std::numeric_limits<double>::infinity();
                for (std::int32_t t = 0; t < static_cast<std::int32_t>(to.faces.size()); ++t) {
                    const Corners q = corners_of(to, t);
                    least = std::min(least, norm(closest_point_on_triangle(x, q[0], q[1], q[2]) - x));
                }
                truth.max = std::max(truth.max, least);
            }
        }
    }
    return truth;
}

void expect_equal(const OneSided& a, const OneSided& b) {
    EXPECT_EQ(a.max, b.max);
    EXPECT_EQ(a.max_bound, b.max_bound);
    EXPECT_EQ(a.rms, b.rms);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.p99, b.p99);
    EXPECT_EQ(a.worst, b.worst);
    EXPECT_EQ(a.normals.mean, b.normals.mean);
    EXPECT_EQ(a.normals.p99, b.normals.p99);
    EXPECT_EQ(a.normals.max, b.normals.max);
    EXPECT_EQ(a.smooth_normals.mean, b.smooth_normals.mean);
}

TEST(Deviation, ParallelSquares) {
    const Deviation d = measure_deviation(square(), square(1, {0, 0, 0.25}));
    for (const OneSided& side : {d.a_to_b, d.b_to_a}) {
        EXPECT_DOUBLE_EQ(side.max, 0.25);
        EXPECT_DOUBLE_EQ(side.max_bound, 0.25);
        EXPECT_DOUBLE_EQ(side.rms, 0.25);
        EXPECT_NEAR(side.mean, 0.25, 1e-12);
        EXPECT_DOUBLE_EQ(side.p99, 0.25);
        EXPECT_EQ(side.normals.max, 0);
    }
    EXPECT_TRUE(d.certified);
}

TEST(Deviation, OneSidedWhereOneSurfaceIsAPartOfTheOther) {
    const Deviation d = measure_deviation(square(0.5), square(1));
    EXPECT_LT(d.a_to_b.max_bound, 1e-11);
    EXPECT_DOUBLE_EQ(d.b_to_a.max, std::sqrt(0.5));
    EXPECT_GE(d.b_to_a.max_bound, std::sqrt(0.5));
    EXPECT_LE(d.b_to_a.max_bound, std::sqrt(0.5) * 1.005);
    EXPECT_EQ(d.max(), d.b_to_a.max);
    EXPECT_EQ(d.rms(), d.b_to_a.rms);
    EXPECT_TRUE(d.certified);
}

TEST(Deviation, ShiftedCube) {
    const Deviation d = measure_deviation(shapes::cube(), shapes::cube(1, {0.1, 0, 0}));
    EXPECT_NEAR(d.max(), 0.1, 1e-12);
    EXPECT_GE(d.max_bound(), 0.1 - 1e-12);
    EXPECT_LE(d.max_bound(), 0.1 * 1.005);
    EXPECT_TRUE(d.certified);
    // Of the six sides of area 4: the rear one is 0.1 off; the front one too, but for its rim, where other
    // sides of the second cube are nearer; of the other four, strips of 0.1 by 2 stick out.
    const double rear = 0.01 * 4, front = 0.01 * 3.24 + 8 * (0.001 / 3 - 0.0001 / 4), strip = 2 * 0.001 / 3;
    EXPECT_NEAR(d.a_to_b.rms, std::sqrt((rear + front + 4 * strip) / 24), 1e-4);
}

TEST(Deviation, ScaledSphere) {
    const Deviation d = measure_deviation(shapes::sphere(4), shapes::sphere(4, 1.1));
    EXPECT_NEAR(d.b_to_a.max, 0.1, 1e-12);
    EXPECT_LE(d.b_to_a.max_bound, 0.1 * 1.005);
    EXPECT_GT(d.a_to_b.max, 0.0995);
    EXPECT_LT(d.a_to_b.max_bound, 0.1 * 1.005);
    EXPECT_NEAR(d.rms(), 0.1, 1e-3);
    EXPECT_LT(d.normals().mean, 3);
    EXPECT_TRUE(d.certified);
}

DeviationOptions with_smooth_normals(std::size_t samples = 20'000) {
    DeviationOptions options;
    options.samples = samples;
    options.bound = false;
    options.smooth_normals = true;
    return options;
}

// A turned cube's sides turn by the angle; what is near an edge may fit another side and is told apart.
TEST(Deviation, NormalsAwayFromCreases) {
    TriangleMesh turned = shapes::cube();
    const double s = 0.004, c = std::sqrt(1 - s * s);  // corners move by a third of the zone
    for (Vec3& v : turned.vertices) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    const double angle = std::atan2(s, c) * 180 / 3.14159265358979323846;
    const Deviation d = measure_deviation(shapes::cube(), turned, with_smooth_normals());
    for (const OneSided& side : {d.a_to_b, d.b_to_a}) {
        EXPECT_GT(side.normals.max, 45);
        EXPECT_NEAR(side.smooth_normals.mean, angle * 2 / 3,
                    0.01 * angle);  // top and bottom turn in themselves
        EXPECT_NEAR(side.smooth_normals.p99, angle, 1e-6);
        EXPECT_NEAR(side.smooth_normals.max, angle, 1e-6);
        EXPECT_LE(side.normals.mean, side.normals.max);
    }
}

// Only the first mesh's creases count: a crease that the second one makes of itself is seen.
TEST(Deviation, FalseCreasesExcuseNothing) {
    TriangleMesh ridge = shapes::cube();
    ridge.vertices.push_back({0, 0, 1.4});
    ASSERT_EQ(ridge.faces[3], (Triangle{4, 7, 6}));  // the upper side becomes a pyramid
    const auto top = static_cast<std::int32_t>(ridge.vertices.size() - 1);
    ridge.faces.erase(ridge.faces.begin() + 2, ridge.faces.begin() + 4);
    for (const auto& [i, j] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}}) ridge.faces.push_back({i, j, top});
    const Deviation d = measure_deviation(shapes::cube(), ridge, with_smooth_normals());
    EXPECT_GT(d.b_to_a.smooth_normals.max, 20);
    const Deviation same = measure_deviation(ridge, shapes::soup(ridge), with_smooth_normals());
    EXPECT_LT(same.smooth_normals().max, 1e-6);
}

// Nothing of a small cube is away from its creases when the reach is that of a large first mesh's diagonal;
// without the wish nothing is measured.
TEST(Deviation, SmoothNormalsOnlyWhereThereAreAny) {
    const TriangleMesh apart = shapes::joined(shapes::cube(1e-3), shapes::cube(1e-3, {1, 0, 0}));
    EXPECT_EQ(measure_deviation(apart, shapes::soup(apart), with_smooth_normals()).smooth_normals().max, 0);
    DeviationOptions options = with_smooth_normals();
    options.smooth_normals = false;
    const Deviation d = measure_deviation(shapes::sphere(2), shapes::sphere(3), options);
    EXPECT_GT(d.normals().mean, 1);
    EXPECT_EQ(d.smooth_normals().max, 0);
    EXPECT_GT(d.normals().p99, d.normals().mean);
    EXPECT_GE(d.normals().max, d.normals().p99);
}

TEST(Deviation, EqualSurfacesUnderOtherTriangulations) {
    const TriangleMesh fine = shapes::bumpy_sphere(3);
    EXPECT_LT(measure_deviation(fine, shapes::soup(fine)).max_bound(), 1e-11);
    TriangleMesh flat = square();
    flat.faces = {{0, 1, 3}, {1, 2, 3}};
    const Deviation d = measure_deviation(square(), flat);
    EXPECT_LT(d.max_bound(), 1e-11);
    EXPECT_TRUE(d.certified);
}

TEST(Deviation, MaximumInsideAFaceThatNoSampleSees) {
    const double half = 1e-4;
    const TriangleMesh whole = square(), holed = square_with_hole(half, {0.3, -0.2, 0});
    const Deviation d = measure_deviation(whole, holed);
    EXPECT_TRUE(d.certified);
    EXPECT_GE(d.a_to_b.max, half / 1.006);
    EXPECT_LE(d.a_to_b.max, half * (1 + 1e-9));
    EXPECT_GE(d.a_to_b.max_bound, half * (1 - 1e-9));
    EXPECT_LE(d.a_to_b.max_bound, half * 1.006);
    EXPECT_NEAR(d.a_to_b.worst.x, 0.3, half);
    EXPECT_NEAR(d.a_to_b.worst.y, -0.2, half);

    DeviationOptions without = only_bound();
    without.samples = 10'000;
    without.bound = false;
    const Deviation blind = measure_deviation(whole, holed, without);
    EXPECT_LT(blind.a_to_b.max, half / 2);
    EXPECT_GE(blind.a_to_b.max_bound, half);
    EXPECT_FALSE(blind.certified);
}

TEST(Deviation, BoundsEncloseTheTruthOnRandomTriangles) {
    Random random(11);
    for (int round = 0; round < 20; ++round) {
        const TriangleMesh a = random_soup(random, 6, round % 2 ? 0.3 : 1), b = random_soup(random, 9, 0.7);
        const Deviation d = measure_deviation(a, b, only_bound());
        const BruteForce ab = brute_force(a, b, 40), ba = brute_force(b, a, 40);
        EXPECT_TRUE(d.certified);
        EXPECT_GE(d.a_to_b.max_bound, ab.max * (1 - 1e-12));
        EXPECT_GE(d.b_to_a.max_bound, ba.max * (1 - 1e-12));
        EXPECT_LE(d.a_to_b.max, ab.max + ab.spacing);
        EXPECT_LE(d.b_to_a.max, ba.max + ba.spacing);
        EXPECT_LE(d.a_to_b.max_bound, d.a_to_b.max * 1.005);
        EXPECT_LE(d.b_to_a.max_bound, d.b_to_a.max * 1.005);
        const double at_worst = std::sqrt(Bvh(b).closest(d.a_to_b.worst).squared_distance);
        EXPECT_DOUBLE_EQ(at_worst, d.a_to_b.max);
    }
}

TEST(Deviation, AnyWorkGivesAValidBound) {
    const TriangleMesh a = shapes::bumpy_sphere(4), b = shapes::bumpy_sphere(3);
    DeviationOptions options = only_bound();
    options.gap = 1e-4;
    const Deviation exact = measure_deviation(a, b, options);
    EXPECT_TRUE(exact.certified);
    double last = std::numeric_limits<double>::infinity();
    for (const std::int64_t work : {0, 5000, 20'000, 100'000, 1'000'000}) {
        options.work = work;
        const Deviation d = measure_deviation(a, b, options);
        EXPECT_LE(d.max(), exact.max_bound());
        EXPECT_GE(d.max_bound(), exact.max());
        EXPECT_LE(d.max_bound(), last);
        if (work <= 5000) {
            EXPECT_FALSE(d.certified);
        } else if (work >= 1'000'000) {
            EXPECT_TRUE(d.certified);
        }
        last = d.max_bound();
    }
}

TEST(Deviation, CertifiesOrRefutesALimit) {
    const TriangleMesh a = shapes::bumpy_sphere(4), b = shapes::bumpy_sphere(3);
    const Deviation exact = measure_deviation(a, b, only_bound());
    const double above = exact.max_bound() * 1.01, below = exact.max() * 0.99;

    const Deviation proved = measure_deviation(a, b, only_bound(above));
    EXPECT_TRUE(proved.certified);
    EXPECT_LE(proved.max_bound(), above);
    EXPECT_GE(proved.max_bound(), exact.max());

    const Deviation refuted = measure_deviation(a, b, only_bound(below));
    EXPECT_FALSE(refuted.certified);
    EXPECT_GT(refuted.max(), below);
    EXPECT_LE(refuted.max(), exact.max_bound());
    EXPECT_GE(refuted.max_bound(), exact.max());
}

TEST(Deviation, RefutesAMaximumInsideAFace) {
    const Deviation d =
        measure_deviation(square(), square_with_hole(0.01, {0.3, -0.2, 0}), only_bound(0.009));
    EXPECT_FALSE(d.certified);
    EXPECT_GT(d.max(), 0.009);
    EXPECT_TRUE(
        measure_deviation(square(), square_with_hole(0.01, {0.3, -0.2, 0}), only_bound(0.0101)).certified);
}

TEST(Deviation, DefectiveInputs) {
    const TriangleMesh point{{{3, 0, 0}}, {{0, 0, 0}}};
    EXPECT_DOUBLE_EQ(measure_deviation(shapes::cube(), point, only_bound()).b_to_a.max, 2);
    EXPECT_TRUE(measure_deviation(shapes::sliver_fan(), shapes::edge_fan(), only_bound()).certified);
    EXPECT_TRUE(measure_deviation(shapes::moebius(), shapes::klein_bottle(), only_bound()).certified);
    EXPECT_THROW(measure_deviation(shapes::cube(), {}), InvalidInput);
    EXPECT_THROW(measure_deviation({}, shapes::cube()), InvalidInput);
    TriangleMesh bad = shapes::cube();
    for (const double x : {std::nan(""), std::numeric_limits<double>::infinity(), -1e200}) {
        bad.vertices[5].y = x;
        EXPECT_THROW(measure_deviation(shapes::cube(), bad), InvalidInput);
        EXPECT_THROW(measure_deviation(bad, shapes::cube()), InvalidInput);
    }
    // Fourth powers of the coordinates overflow, then underflow.
    for (const double size : {1e120, 1e-120}) {
        const TriangleMesh a = shapes::scaled(shapes::sphere(2), {size, size, size});
        const TriangleMesh b = shapes::scaled(shapes::sphere(2), {1.5 * size, 1.5 * size, 1.5 * size});
        const Deviation d = measure_deviation(a, b, only_bound());
        EXPECT_NEAR(d.max() / size, 0.5, 1e-12);
        EXPECT_TRUE(d.certified);
    }

    TriangleMesh stray = shapes::cube();
    stray.vertices.push_back({100, 0, 0});  // used by no face
    EXPECT_LT(measure_deviation(shapes::cube(), stray).max_bound(), 1e-11);
}

TEST(Deviation, SameForAnyNumberOfThreads) {
    const TriangleMesh a = shapes::bumpy_sphere(4), b = shapes::torus();
    DeviationOptions options;
    options.samples = 5000;
    Task one, three;
    one.threads = 1;
    three.threads = 3;
    const Deviation d1 = measure_deviation(a, b, options, one), d3 = measure_deviation(a, b, options, three);
    expect_equal(d1.a_to_b, d3.a_to_b);
    expect_equal(d1.b_to_a, d3.b_to_a);
}

TEST(Deviation, ReportsProgressAndCanBeCancelled) {
    CancelToken token;
    double last = 0;
    Task task;
    task.cancel = &token;
    task.progress = [&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    measure_deviation(shapes::sphere(2), shapes::cube(), {}, task);
    EXPECT_EQ(last, 1);
    task.progress = [&](double, std::string_view) { token.cancel(); };
    EXPECT_THROW(measure_deviation(shapes::sphere(2), shapes::cube(), {}, task), Cancelled);
}

}  // namespace
}  // namespace pfgeom
