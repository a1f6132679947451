#include "pfgeom/mesh/triangle_mesh.h"

#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

TEST(TriangleMesh, BoundsAreOfTheVerticesInUse) {
    TriangleMesh mesh = shapes::cube(2, {1, 0, 0});
    mesh.vertices.push_back({100, 100, 100});
    EXPECT_EQ(bounds(mesh).lo, (Vec3{-1, -2, -2}));
    EXPECT_EQ(bounds(mesh).hi, (Vec3{3, 2, 2}));
    EXPECT_DOUBLE_EQ(diagonal(mesh), std::sqrt(48.0));
    EXPECT_TRUE(bounds({}).empty());
    EXPECT_EQ(diagonal({}), 0);
}

TEST(TriangleMesh, AreaOfWhatIsKnown) {
    EXPECT_DOUBLE_EQ(surface_area(shapes::cube()), 24);
    EXPECT_NEAR(surface_area(shapes::sphere(6)), 12.566, 0.01);
    EXPECT_EQ(surface_area(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}), 0);
}

}  // namespace
}  // namespace pfgeom
