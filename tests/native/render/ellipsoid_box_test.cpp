#include "pfgeom/render/ellipsoid_box.h"

#include "brute_force.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

// q(p) = 1 - |M (p - c)|²
Quadric ellipsoid(const std::array<Vec3, 3>& m, const Vec3& c) {
    Quadric q;
    for (const Vec3& row : m) {
        const double k = dot(row, c);
        const std::array<double, 10> square{
            row.x * row.x,     row.y * row.y,  row.z * row.z,  2 * row.x * row.y, 2 * row.x * row.z,
            2 * row.y * row.z, -2 * k * row.x, -2 * k * row.y, -2 * k * row.z,    k * k};
        for (std::size_t i = 0; i < 10; ++i) q.c[i] -= square[i];
    }
    q.c[9] += 1;
    return q;
}

// No point outside of the box is inside, and on each side some nearly are.
TEST(EllipsoidBox, HoldsItTightly) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const std::array<Vec3, 3> m{test::any_point(random), test::any_point(random),
                                    test::any_point(random)};
        if (std::abs(dot(m[0], cross(m[1], m[2]))) < 0.05) continue;
        const Quadric q = ellipsoid(m, test::any_point(random, 2));
        const auto box = ellipsoid_box(q);
        ASSERT_TRUE(box.has_value()) << i;
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool high : {false, true}) {
                // The largest value on a side of the box, by coordinate ascent: the quadric is concave.
                Vec3 p = box->centre();
                p[axis] = (high ? box->hi : box->lo)[axis];
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                for (int step = 0; step < 2000; ++step) {
                    for (const int k : {u, v})
                        p[k] += q.gradient(p)[k] / (-2 * q.c[static_cast<std::size_t>(k)]);
                }
                const double slope = norm(q.gradient(p)), distance = q.value(p) / slope;
                EXPECT_LE(distance, 0) << i;
                EXPECT_GE(distance, -1e-5 * box->diagonal()) << i;
            }
        }
    }
}

TEST(EllipsoidBox, OtherQuadricsHaveNone) {
    EXPECT_FALSE(ellipsoid_box({{-1, -1, 0, 0, 0, 0, 0, 0, 0, 1}}));    // a cylinder
    EXPECT_FALSE(ellipsoid_box({{-1, -1, 1, 0, 0, 0, 0, 0, 0, 1}}));    // a hyperboloid
    EXPECT_FALSE(ellipsoid_box({{1, 1, 1, 0, 0, 0, 0, 0, 0, -1}}));     // all but a ball
    EXPECT_FALSE(ellipsoid_box({{-1, -1, -1, 0, 0, 0, 0, 0, 0, -1}}));  // nothing
    EXPECT_FALSE(ellipsoid_box({{0, 0, 0, 0, 0, 0, 1, 0, 0, 0}}));      // a half space
    EXPECT_FALSE(ellipsoid_box({{-1, -1, -1e-9, 0, 0, 0, 0, 0, 0, 1}}));
}

}  // namespace
}  // namespace pfgeom
