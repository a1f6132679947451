#include "pfgeom/mesh/islands.h"

#include "pfgeom/mesh/prepare.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

PreparedMesh prepared(const TriangleMesh& mesh) {
    return prepare_mesh(mesh, 0);
}

TEST(Islands, OpenAndOneSidedSurfaces) {
    const PreparedMesh cone = prepared(shapes::open_cone(32));
    EXPECT_EQ(cone.defects.boundary_edges, 32);
    EXPECT_FALSE(cone.islands.at(0).closed);
    EXPECT_TRUE(cone.islands.at(0).manifold && cone.islands.at(0).oriented);

    const PreparedMesh band = prepared(shapes::moebius(48));
    EXPECT_EQ(band.defects.boundary_edges, 2 * 48);
    EXPECT_TRUE(band.islands.at(0).manifold);
    EXPECT_FALSE(band.islands.at(0).closed || band.islands.at(0).oriented);

    const PreparedMesh bottle = prepared(shapes::klein_bottle(32, 16));
    EXPECT_TRUE(bottle.islands.at(0).closed && bottle.islands.at(0).manifold);
    EXPECT_FALSE(bottle.islands.at(0).oriented);
    EXPECT_EQ(bottle.defects.misoriented_edges, 16);
}

TEST(Islands, TurnedFacesAreMisorientedEdges) {
    TriangleMesh mesh = shapes::sphere(2);
    std::swap(mesh.faces[40][0], mesh.faces[40][1]);
    const PreparedMesh sphere = prepared(mesh);
    EXPECT_EQ(sphere.defects.misoriented_edges, 3);
    EXPECT_TRUE(sphere.islands.at(0).closed);
    EXPECT_FALSE(sphere.islands.at(0).oriented);
}

TEST(Islands, NonManifoldEdgesAndVertices) {
    const PreparedMesh fan = prepared(shapes::edge_fan(5));
    EXPECT_EQ(fan.defects.non_manifold_edges, 1);
    EXPECT_EQ(fan.defects.boundary_edges, 10);
    EXPECT_EQ(fan.defects.non_manifold_vertices, 0);
    EXPECT_EQ(fan.islands.size(), 1u);
    EXPECT_FALSE(fan.islands[0].manifold || fan.islands[0].closed);

    const PreparedMesh tie = prepared(shapes::cubes_sharing_vertex());
    EXPECT_EQ(tie.defects.non_manifold_vertices, 1);
    EXPECT_EQ(tie.defects.non_manifold_edges, 0);
    ASSERT_EQ(tie.islands.size(), 2u);
    for (const Island& island : tie.islands) EXPECT_TRUE(island.closed && !island.manifold);

    const PreparedMesh edge = prepared(shapes::cubes_sharing_edge());
    EXPECT_EQ(edge.defects.non_manifold_edges, 1);
    ASSERT_EQ(edge.islands.size(), 1u);
    EXPECT_TRUE(edge.islands[0].closed && edge.islands[0].oriented && !edge.islands[0].manifold);
    EXPECT_NEAR(edge.islands[0].signed_volume, 16, 1e-12);
}

TEST(Islands, OnePieceIsAllOfTheVertices) {
    const TriangleMesh sphere = shapes::sphere(1);
    EXPECT_TRUE(in_one_piece(sphere));
    EXPECT_FALSE(in_one_piece(shapes::joined(sphere, shapes::translated(sphere, {5, 0, 0}))));
    EXPECT_TRUE(in_one_piece(shapes::cubes_sharing_vertex())) << "a vertex holds it together";
    EXPECT_FALSE(in_one_piece({}));
}

TEST(Islands, AreInTheOrderOfTheirLowestFace) {
    TriangleMesh mesh = shapes::joined(shapes::cube(1, {9, 0, 0}), shapes::cube());
    std::swap(mesh.faces[0], mesh.faces[23]);
    const PreparedMesh two = prepared(mesh);
    ASSERT_EQ(two.islands.size(), 2u);
    EXPECT_EQ(two.islands[0].faces.front(), 0);
    EXPECT_EQ(two.islands[1].faces.front(), 1);
    EXPECT_EQ(two.mesh.vertices[two.mesh.faces[0][0]].x < 5, true);
}

TEST(Islands, VolumeAndAreaFarFromTheOrigin) {
    const PreparedMesh cube = prepared(shapes::cube(1, {1e6, -1e6, 1e6}));
    EXPECT_NEAR(cube.islands.at(0).signed_volume, 8, 1e-9);
    EXPECT_NEAR(prepared(shapes::flipped(shapes::cube())).islands.at(0).signed_volume, -8, 1e-12);
    EXPECT_NEAR(cube.islands[0].area, 24, 1e-9);
}

TEST(Nesting, ShellsAreEachInTheNextOneOut) {
    const PreparedMesh shells = prepared(shapes::nested_shells(5));
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(shells.islands.at(i).parent, static_cast<int>(i) - 1);
}

TEST(Nesting, BoxesAloneDoNotNest) {
    // In the torus's box, but in its hole; and through its tube.
    const TriangleMesh hole = shapes::joined(shapes::torus(), shapes::sphere(2, 0.2));
    const TriangleMesh across = shapes::joined(shapes::torus(), shapes::sphere(2, 0.3, {1, 0, 0.15}));
    const TriangleMesh within = shapes::joined(shapes::torus(), shapes::sphere(2, 0.2, {1, 0, 0}));
    EXPECT_EQ(prepared(hole).islands.at(1).parent, -1);
    EXPECT_EQ(prepared(across).islands.at(1).parent, -1);
    EXPECT_EQ(prepared(within).islands.at(1).parent, 0);
}

TEST(Nesting, OpenIslandsHaveNoParentAndAreNone) {
    const TriangleMesh open_inside = shapes::joined(shapes::cube(3), shapes::open_cone());
    EXPECT_EQ(prepared(open_inside).islands.at(1).parent, -1);
    const TriangleMesh open_outside =
        shapes::joined(shapes::scaled(shapes::open_cone(), {9, 9, 9}), shapes::cube(0.1, {0, 0, 3}));
    EXPECT_EQ(prepared(open_outside).islands.at(1).parent, -1);
}

TEST(Nesting, ScenesOfManyIslands) {
    for (const int n : {2, 50, 1000}) {
        const PreparedMesh scene = prepared(shapes::scene_of_islands(n));
        ASSERT_EQ(scene.islands.size(), static_cast<std::size_t>(n));
        for (int i = 0; i < n; ++i) EXPECT_EQ(scene.islands[i].parent, i % 8 == 1 ? i - 1 : -1) << i;
    }
}

}  // namespace
}  // namespace pfgeom
