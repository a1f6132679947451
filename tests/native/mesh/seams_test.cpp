#include "pfgeom/base/random.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/prepare.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

TriangleMesh jittered(TriangleMesh mesh, double by, std::uint64_t seed) {
    Random random(seed);
    for (Vec3& v : mesh.vertices)
        v += Vec3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5} * by;
    return mesh;
}

TEST(Seams, CracksOfStlFiles) {
    const double gap = 1e-6;
    const TriangleMesh mesh = jittered(shapes::soup(shapes::torus()), gap, 1);
    EXPECT_EQ(prepare_mesh(mesh, 0).islands.size(), 1024u);
    const PreparedMesh prepared = prepare_mesh(mesh, 4 * gap);
    ASSERT_EQ(prepared.islands.size(), 1u);
    EXPECT_TRUE(prepared.islands[0].closed && prepared.islands[0].manifold && prepared.islands[0].oriented);
    EXPECT_EQ(prepared.defects.seam_edges, 3 * 1024);
    EXPECT_EQ(prepared.defects.boundary_edges, 0);
    EXPECT_EQ(prepared.mesh.vertices.size(), shapes::torus().vertices.size());
}

TEST(Seams, TJunctionsOfOneEdge) {
    const PreparedMesh prepared = prepare_mesh(shapes::cracked_cube(1e-5), 4e-5);
    ASSERT_EQ(prepared.islands.size(), 1u);
    EXPECT_TRUE(prepared.islands[0].closed && prepared.islands[0].manifold && prepared.islands[0].oriented);
    EXPECT_EQ(prepared.mesh.faces.size(), 14u);  // 13, and the top's face was split
    EXPECT_EQ(prepared.defects.seam_edges, 39);
    EXPECT_NEAR(prepared.islands[0].signed_volume, 8, 1e-3);
}

/// The unit square as two strips that meet at x = 1/2 with different vertices on their common side.
TriangleMesh strips(int left, int right) {
    TriangleMesh mesh;
    for (const auto& [cells, x] : {std::pair{left, 0.0}, std::pair{right, 0.5}}) {
        TriangleMesh strip;
        for (int i = 0; i <= cells; ++i)
            for (const double dx : {0.0, 0.5})
                strip.vertices.push_back({x + dx, static_cast<double>(i) / cells, 0});
        strip.faces = shapes::grid_faces(cells + 1, 2, false, false);
        shapes::append(mesh, strip);
    }
    return mesh;
}

TEST(Seams, ChainsOfTJunctionsOnBothSides) {
    for (const auto& [left, right] : {std::pair{1, 5}, std::pair{3, 4}, std::pair{4, 8}, std::pair{7, 9}}) {
        const PreparedMesh prepared = prepare_mesh(strips(left, right), 1e-9);
        EXPECT_EQ(prepared.islands.size(), 1u) << left << " " << right;
        EXPECT_EQ(prepared.defects.seam_edges, left + right);
        EXPECT_NEAR(surface_area(prepared.mesh), 1, 1e-9);
        EXPECT_EQ(prepared.defects.misoriented_edges, 0);
    }
}

TEST(Seams, FlatFillersLeaveNoHole) {
    // A face without area joins the long edge 0-1 with the two short ones through 2.
    const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                            {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}, {2, 4, 1}}};
    const PreparedMesh prepared = prepare_mesh(mesh, 1e-9);
    EXPECT_EQ(prepared.defects.degenerate_faces, 1);
    EXPECT_EQ(prepared.islands.size(), 1u);
    EXPECT_EQ(prepared.defects.boundary_edges, 4);
}

TEST(Seams, NothingMovesFurtherThanTheDistance) {
    const double distance = 0.02;
    for (const TriangleMesh& mesh : {jittered(shapes::soup(shapes::bumpy_sphere(3)), 0.01, 2),
                                     shapes::moebius(), shapes::sliver_fan(40, 500), strips(40, 7)}) {
        const PreparedMesh prepared = prepare_mesh(mesh, distance);
        const Bvh before(mesh), after(prepared.mesh);
        for (const Vec3& v : prepared.mesh.vertices) EXPECT_EQ(before.closest(v).squared_distance, 0);
        for (const Triangle& f : mesh.faces) {
            const Vec3 centre = (mesh.vertices[f[0]] + mesh.vertices[f[1]] + mesh.vertices[f[2]]) / 3;
            EXPECT_LE(after.closest(centre).squared_distance, distance * distance);
        }
        for (const Triangle& f : prepared.mesh.faces) {
            const Vec3 centre =
                (prepared.mesh.vertices[f[0]] + prepared.mesh.vertices[f[1]] + prepared.mesh.vertices[f[2]]) /
                3;
            EXPECT_LE(before.closest(centre).squared_distance, distance * distance);
        }
    }
}

TEST(Seams, FacesSmallerThanTheDistanceSurvive) {
    const TriangleMesh mesh = shapes::soup(shapes::sphere(3));
    const PreparedMesh prepared = prepare_mesh(mesh, 0.0);
    const TriangleMesh strip{{{0, 0, 0}, {0, 1e-3, 0}, {1, 0, 0}, {1, 1e-3, 0}}, {{0, 2, 1}, {1, 2, 3}}};
    EXPECT_EQ(prepare_mesh(strip, 0.01).mesh.faces.size(), 2u);
    EXPECT_EQ(prepared.mesh.faces.size(), mesh.faces.size());
}

TEST(Seams, AnyScaleOfTheDistanceEnds) {
    const TriangleMesh far_away = shapes::translated(shapes::soup(shapes::cube()), {1e12, -1e12, 1e12});
    for (const double distance : {1e-320, 1e-30, 1e-6, 1.0, 1e30, 1e300})
        EXPECT_FALSE(prepare_mesh(far_away, distance).mesh.faces.empty()) << distance;
}

TEST(Seams, OpenBoundariesStayOpen) {
    const PreparedMesh prepared = prepare_mesh(shapes::open_cone(), 1e-3);
    EXPECT_EQ(prepared.defects.seam_edges, 0);
    EXPECT_EQ(prepared.defects.boundary_edges, 32);
    EXPECT_EQ(prepared.mesh.faces, shapes::open_cone().faces);
}

}  // namespace
}  // namespace pfgeom
