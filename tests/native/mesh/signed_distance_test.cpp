#include "pfgeom/mesh/signed_distance.h"

#include "pfgeom/base/random.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

void expect_sides_of_winding_numbers(const TriangleMesh& mesh) {
    const Bvh bvh(mesh);
    const SignedDistance distance(mesh, bvh);
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        const auto coordinate = [&] { return 3 * random.uniform() - 1.5; };
        const Vec3 p{coordinate(), coordinate(), coordinate()};
        const double expected = bvh.signed_distance(p), found = distance(p).distance;
        EXPECT_NEAR(found, expected, 1e-12) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

TEST(SignedDistance, AgreesWithWindingNumbers) {
    expect_sides_of_winding_numbers(shapes::torus());
    expect_sides_of_winding_numbers(shapes::bumpy_sphere(2, 0.6));
}

TEST(SignedDistance, KnowsItsSideNearKnifeEdges) {
    // A flat double pyramid: most points are nearest to its rim, whose faces contradict each other.
    expect_sides_of_winding_numbers(shapes::scaled(shapes::sphere(0), {1, 1, 0.02}));
    // A long thin one: nearest to its tips.
    expect_sides_of_winding_numbers(shapes::scaled(shapes::sphere(0), {0.05, 0.05, 1}));
}

}  // namespace
}  // namespace pfgeom
