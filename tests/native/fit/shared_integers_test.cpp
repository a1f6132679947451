#include "pfgeom/fit/shared_integers.h"

#include "pfgeom/codec/tree_quadric_codec.h"
#include "pfgeom/function/quadric_family.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

namespace pfgeom {
namespace {

constexpr int kResolution = 11;
constexpr double kLimit = 0.9e-3;

// The walls of a cylinder along z.
RegionChecks wall(double radius, const Vec3& at, double limit = kLimit) {
    TriangleMesh mesh = shapes::scaled(shapes::cylinder(64), {radius, radius, 0.25});
    RegionChecks checks;
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3 a = mesh.vertices[i] + at, b = mesh.vertices[j] + at, c = mesh.vertices[k] + at;
        if (std::abs(normalized(cross(b - a, c - a)).z) > 0.5) continue;
        checks.sums.add_triangle(a, b, c);
        for (const Vec3& p : {a, b, c}) checks.points.push_back({p, limit});
    }
    return checks;
}

std::vector<QuantisedQuadric> each_alone(std::vector<RegionChecks> checks) {
    std::vector<QuantisedQuadric> quadrics;
    for (RegionChecks& c : checks) {
        const auto found = quantise(c.sums, c.points, kResolution, 40, kLimit * kLimit);
        if (found) quadrics.push_back(*found);
    }
    return quadrics;
}

std::vector<QuantisedQuadric> shared(const std::vector<RegionChecks>& checks, std::size_t tries,
                                     int threads) {
    std::vector<QuantisedQuadric> quadrics = each_alone(checks);
    EXPECT_EQ(quadrics.size(), checks.size());
    share_integers(checks, kResolution, kLimit * kLimit, tries, quadrics, Task{threads, nullptr, {}});
    return quadrics;
}

double coded_bits(const std::vector<QuantisedQuadric>& quadrics) {
    std::vector<TreeQuadric> list;
    for (const QuantisedQuadric& q : quadrics) list.push_back(q.quadric);
    CodecStream stream;
    BackoffModel model;
    TreeQuadricCoder coder(stream, model);
    for (std::size_t i = 0; i < list.size(); ++i) coder.code(list, i, kResolution);
    return stream.coder.bits_so_far();
}

double estimate(const std::vector<QuantisedQuadric>& quadrics) {
    double sum = 0;
    for (const QuantisedQuadric& q : quadrics) sum += q.bits;
    return sum;
}

// Holes whose radii differ by less than the tolerance, where nobody would expect it.
std::vector<RegionChecks> nine_holes() {
    std::vector<RegionChecks> holes;
    for (int i = 0; i < 9; ++i) {
        const double x = 0.61 * (i % 3 - 1) + 0.0003 * i, y = 0.47 * (i / 3 - 1) - 0.0002 * i;
        holes.push_back(wall(0.1 + 0.00005 * i, {x, y, 0}));
    }
    return holes;
}

TEST(SharedIntegers, HolesOfOneRadiusAndInRows) {
    const std::vector<RegionChecks> holes = nine_holes();
    const std::vector<QuantisedQuadric> alone = each_alone(holes), together = shared(holes, 16, 2);
    for (std::size_t i = 0; i < holes.size(); ++i) {
        EXPECT_TRUE(passes(together[i].quadric.quadric, holes[i].points)) << i;
        EXPECT_EQ(together[i].quadric.quadric, expand(together[i].quadric, kResolution));
        EXPECT_LE(together[i].bits, alone[i].bits);
    }
    EXPECT_LT(estimate(together), 0.85 * estimate(alone));
    EXPECT_LT(coded_bits(together), 0.9 * coded_bits(alone));
}

TEST(SharedIntegers, MoreOrdersAreNotWorseAndThreadsChangeNothing) {
    const std::vector<RegionChecks> holes = nine_holes();
    const std::vector<QuantisedQuadric> one = shared(holes, 1, 1), many = shared(holes, 16, 1);
    EXPECT_LE(estimate(many), estimate(one));
    const std::vector<QuantisedQuadric> threaded = shared(holes, 16, 2);
    for (std::size_t i = 0; i < holes.size(); ++i) EXPECT_EQ(many[i].quadric, threaded[i].quadric);
}

TEST(SharedIntegers, PlanesOnBothSides) {
    std::vector<RegionChecks> sides(2);
    for (int i = 0; i < 2; ++i) {
        const double x = i == 0 ? 0.4003 : -0.3999, out = i == 0 ? 1 : -1;
        const Vec3 a{x, -0.3, -0.3}, b{x, 0.3, -0.3}, c{x, 0, 0.3};
        RegionChecks& side = sides[static_cast<std::size_t>(i)];
        if (out > 0)
            side.sums.add_triangle(a, b, c);
        else
            side.sums.add_triangle(a, c, b);
        for (const Vec3& p : {a, b, c}) side.points.push_back({p, kLimit});
    }
    const std::vector<QuantisedQuadric> together = shared(sides, 4, 1);
    EXPECT_EQ(together[0].quadric.family, 0);
    EXPECT_EQ(std::abs(together[0].quadric.n[1]), std::abs(together[1].quadric.n[1]));
    EXPECT_NE(together[0].quadric.n[0], together[1].quadric.n[0]);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(passes(together[i].quadric.quadric, sides[i].points));
}

TEST(SharedIntegers, NothingMovesWhereThereIsNoRoom) {
    const std::vector<RegionChecks> walls{wall(0.1, {0.5, 0.4, 0}), wall(0.31, {-0.43, 0.2, 0}),
                                          wall(0.22, {-0.3, -0.55, 0})};
    std::vector<QuantisedQuadric> quadrics = each_alone(walls);
    const std::vector<QuantisedQuadric> before = quadrics;
    std::vector<RegionChecks> tight = walls;
    for (RegionChecks& c : tight) {
        for (CheckPoint& p : c.points) p.limit = 0;
    }
    share_integers(tight, kResolution, kLimit * kLimit, 4, quadrics);
    for (std::size_t i = 0; i < walls.size(); ++i) EXPECT_EQ(quadrics[i].quadric, before[i].quadric);
}

TEST(SharedIntegers, OfNoneAndOfOne) {
    std::vector<QuantisedQuadric> none;
    share_integers({}, kResolution, kLimit * kLimit, 4, none);
    EXPECT_TRUE(none.empty());
    const std::vector<RegionChecks> single{wall(0.1, {0.5, 0.4, 0})};
    EXPECT_EQ(shared(single, 4, 1)[0].quadric, each_alone(single)[0].quadric);
}

TEST(SharedIntegers, CanBeStopped) {
    const std::vector<RegionChecks> holes = nine_holes();
    std::vector<QuantisedQuadric> quadrics = each_alone(holes);
    CancelToken token;
    token.cancel();
    EXPECT_THROW(share_integers(holes, kResolution, kLimit * kLimit, 4, quadrics, Task{1, &token, {}}),
                 Cancelled);
}

}  // namespace
}  // namespace pfgeom
