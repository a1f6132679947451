#include "pfgeom/fit/moments.h"

#include "eval/random_functions.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using test::random_point;

struct Sample {
    Vec3 point, normal;
};

// Points of an ellipsoid with outward normals.
std::vector<Sample> ellipsoid(const Vec3& axes, const Vec3& centre, int count) {
    Random random(3);
    std::vector<Sample> samples;
    while (static_cast<int>(samples.size()) < count) {
        const Vec3 d = random_point(random);
        if (norm(d) < 0.1) continue;
        const Vec3 u = normalized(d);
        const Vec3 p{u.x * axes.x, u.y * axes.y, u.z * axes.z};
        const Vec3 n{u.x / axes.x, u.y / axes.y, u.z / axes.z};
        samples.push_back({p + centre, normalized(n)});
    }
    return samples;
}

TEST(Moments, FindTheEllipsoidThroughItsPoints) {
    const auto samples = ellipsoid({0.8, 0.5, 0.3}, {0.1, -0.05, 0.2}, 300);
    Moments moments;
    for (const Sample& s : samples) moments.add(s.point, s.normal, 1);
    const Quadric q = moments.solve(1e-6);
    for (const Sample& s : samples) {
        EXPECT_NEAR(q.value(s.point) / norm(q.gradient(s.point)), 0, 1e-5);
        EXPECT_LT(dot(q.gradient(s.point), s.normal), 0) << "inside is positive";
    }
}

TEST(Moments, FindAQuadricThroughTheOrigin) {
    const auto samples = ellipsoid({0.5, 0.5, 0.5}, {0.5, 0, 0}, 200);
    Moments moments;
    for (const Sample& s : samples) moments.add(s.point, s.normal, 1);
    const Quadric q = moments.solve(1e-6);
    for (const Sample& s : samples) EXPECT_NEAR(q.value(s.point) / norm(q.gradient(s.point)), 0, 1e-5);
}

TEST(Moments, ParentIsTheSumOfItsTransformedChildren) {
    const auto samples = ellipsoid({0.7, 0.6, 0.5}, {0, 0.1, 0}, 400);
    Moments direct, children;
    for (int octant = 0; octant < 8; ++octant) {
        const Vec3 shift{(octant & 1) != 0 ? 0.5 : -0.5, (octant & 2) != 0 ? 0.5 : -0.5,
                         (octant & 4) != 0 ? 0.5 : -0.5};
        Moments child;
        for (const Sample& s : samples) {
            const int side = (s.point.x >= 0 ? 1 : 0) + (s.point.y >= 0 ? 2 : 0) + (s.point.z >= 0 ? 4 : 0);
            if (side != octant) continue;
            child.add((s.point - shift) * 2, s.normal, 1);
            direct.add(s.point, s.normal, 1);
        }
        children += child.in_frame(2, -2 * shift);  // child's point = 2 p - 2 shift
    }
    const Quadric a = direct.solve(0.01), b = children.solve(0.01);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(a.c[i], b.c[i], 1e-9);
    EXPECT_EQ(direct.weight(), children.weight());
}

}  // namespace
}  // namespace pfgeom
