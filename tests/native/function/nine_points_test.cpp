#include "pfgeom/function/nine_points.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pfgeom {
namespace {

using Points = std::vector<Vec3>;

Vec3 random_point(Random& random) {
    const auto coordinate = [&random] { return 2 * random.uniform() - 1; };
    const double x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
}

Points random_points(Random& random, std::size_t count) {
    Points points(count);
    for (Vec3& p : points) p = random_point(random);
    return points;
}

/// On the unit sphere, spread by the golden angle's irrational steps.
Points sphere_points(const Vec3& centre, const Vec3& radii) {
    Random random(5);
    Points points;
    while (points.size() < 9) {
        const Vec3 u = normalized(random_point(random));
        points.push_back(centre + Vec3{u.x * radii.x, u.y * radii.y, u.z * radii.z});
    }
    return points;
}

double difference(const Quadric& a, const Quadric& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.c.size(); ++i) largest = std::max(largest, std::abs(a.c[i] - b.c[i]));
    return largest;
}

TEST(NinePoints, FindsTheEllipsoidAndIsPositiveInside) {
    // 1 - (x-1)²/4 - (y+2)² - (z-3)²/9
    Quadric expected{{-0.25, -1, -1.0 / 9, 0, 0, 0, 0.5, -4, 2.0 / 3, 1 - 0.25 - 4 - 1}};
    double sum = 0;
    for (const double c : expected.c) sum += c * c;
    for (double& c : expected.c) c /= std::sqrt(sum);
    const Quadric found = nine_points(sphere_points({1, -2, 3}, {2, 1, 3}));
    EXPECT_LT(difference(found, expected), 1e-12);
    EXPECT_GT(found.value({1, -2, 3}), 0);
}

TEST(NinePoints, GoesThroughPointsAtRandom) {
    Random random(1);
    for (int round = 0; round < 200; ++round) {
        const Points points = random_points(random, 9);
        const Quadric q = nine_points(points);
        for (const Vec3& p : points) EXPECT_LT(std::abs(q.value(p)), 1e-14);
    }
}

TEST(NinePoints, FindsAQuadricThroughTheOrigin) {
    // The cone x² + y² = z², whose constant is 0: a fixed constant cannot give it.
    Points points{{0, 0, 0}};
    for (int i = 0; i < 8; ++i) {
        const double z = (i % 2 == 0 ? 1 : -1) * (0.4 + 0.1 * i);
        const Vec3 u = normalized(Vec3{std::sqrt(2.0 + i) - 2.4, std::sqrt(11.0 - i) - 2.7, 0});
        points.push_back({u.x * z, u.y * z, z});
    }
    const double s = 1 / std::sqrt(3.0);
    EXPECT_LT(difference(nine_points(points), Quadric{{-s, -s, s}}), 1e-9);
}

TEST(NinePoints, DoesNotDependOnTheOrderButForRounding) {
    Random random(3);
    Points points = random_points(random, 9);
    const Quadric forward = nine_points(points);
    std::reverse(points.begin(), points.end());
    EXPECT_LT(difference(nine_points(points), forward), 1e-11);
}

TEST(NinePoints, ScalesAndMovesWithThePoints) {
    for (const double scale : {1e-30, 1e-3, 1e3, 1e30}) {
        const Vec3 centre = Vec3{1, -2, 3} * scale;
        const Quadric q = nine_points(sphere_points(centre, Vec3{2, 1, 3} * scale));
        const Vec3 tip = centre + Vec3{2, 0, 0} * scale;
        EXPECT_LT(std::abs(q.value(tip)) / norm(q.gradient(tip)), 1e-10 * scale) << scale;
    }
}

TEST(NinePoints, RefusesWhatLeavesMoreThanOne) {
    Random random(7);
    const auto refused = [](const Points& points) {
        try {
            nine_points(points);
            return false;
        } catch (const InvalidInput&) {
            return true;
        }
    };
    for (int round = 0; round < 50; ++round) {
        const Points free = random_points(random, 9);
        Points twice = free, line = free, plane = free, corners = free;
        twice[8] = twice[2];
        for (std::size_t i = 0; i < 4; ++i) line[i] = free[0] + (free[1] - free[0]) * (0.3 * double(i));
        for (std::size_t i = 0; i < 7; ++i) plane[i].z = 0.3 * free[i].x - 0.7 * free[i].y + 0.1;
        for (unsigned i = 0; i < 8; ++i) {
            corners[i] = {(i & 1U) != 0 ? 0.9 : -0.7, (i & 2U) != 0 ? 0.8 : -0.4, (i & 4U) != 0 ? 1.0 : -0.1};
        }
        EXPECT_FALSE(refused(free));
        EXPECT_TRUE(refused(twice));
        EXPECT_TRUE(refused(line));
        EXPECT_TRUE(refused(plane));
        EXPECT_TRUE(refused(corners));
    }
    EXPECT_TRUE(refused(Points(9, Vec3{1, 2, 3})));
}

TEST(NinePoints, RefusesWrongNumbers) {
    Random random(9);
    EXPECT_THROW(nine_points(random_points(random, 8)), InvalidInput);
    EXPECT_THROW(nine_points(random_points(random, 10)), InvalidInput);
    EXPECT_THROW(nine_points({}), InvalidInput);
    Points points = random_points(random, 9);
    points[4].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(nine_points(points), InvalidInput);
    points[4].y = 1e300;
    EXPECT_THROW(nine_points(points), InvalidInput);
}

}  // namespace
}  // namespace pfgeom
