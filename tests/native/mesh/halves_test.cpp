#include "pfgeom/mesh/halves.h"

#include "pfgeom/mesh/edges.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

std::vector<std::int32_t> borders(const TriangleMesh& mesh) {
    return EdgeTable(mesh.faces, mesh.vertices.size()).boundary();
}

TEST(Halves, TogetherAreTheWhole) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    for (int axis = 0; axis < 3; ++axis) {
        const AxisPlane plane{axis, 0.1234};
        const TriangleMesh above = half_above(mesh, plane, 0),
                           below = mirrored(half_above(mirrored(mesh, plane), plane, 0), plane);
        EXPECT_NEAR(surface_area(above) + surface_area(below), surface_area(mesh), 1e-12);
        EXPECT_NEAR(diagonal(shapes::joined(above, below)), diagonal(mesh), 1e-12);
    }
}

TEST(Halves, TheCutIsOnThePlaneAndTheRestAbove) {
    const AxisPlane plane{1, -0.3};
    const TriangleMesh half = half_above(shapes::torus(), plane, 0);
    for (const Vec3& v : half.vertices) EXPECT_GE(v.y, plane.at);
    const std::vector<std::int32_t> sides = borders(half);
    EXPECT_GT(sides.size(), 20U);
    for (const std::int32_t side : sides) {
        const Triangle& t = half.faces[static_cast<std::size_t>(side / 3)];
        for (const int k : {side % 3, (side + 1) % 3})
            EXPECT_EQ(half.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])].y, plane.at);
    }
}

TEST(Halves, WhatIsNearThePlaneGoesOntoIt) {
    const TriangleMesh mesh = shapes::translated(shapes::sphere(3), {1e-4, 0, 0});
    const TriangleMesh half = half_above(mesh, {0, 0}, 1e-3);
    EXPECT_EQ(half.faces.size(), mesh.faces.size() / 2) << "no edge is cut";
    for (const Vec3& v : half.vertices) EXPECT_TRUE(v.x == 0 || v.x > 1e-3);
}

TEST(Halves, FacesInThePlaneAreLeftOut) {
    EXPECT_TRUE(half_above(shapes::saddle(4, 0), {2, 0}, 0).faces.empty());
    EXPECT_EQ(half_above(shapes::cube(), {2, -1}, 0).faces.size(), 10U);
}

TEST(Halves, AnImageOfAnImageIsTheMesh) {
    const TriangleMesh mesh = shapes::torus(), twice = mirrored(mirrored(mesh, {2, 0.5}), {2, 0.5});
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        EXPECT_LT(norm(twice.vertices[v] - mesh.vertices[v]), 1e-15);
    EXPECT_EQ(twice.faces, mesh.faces);
}

}  // namespace
}  // namespace pfgeom
