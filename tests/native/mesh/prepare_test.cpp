#include "pfgeom/mesh/prepare.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::string complaint(const TriangleMesh& mesh) {
    try {
        prepare_mesh(mesh, 0);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return {};
}

TEST(Prepare, RefusesValuesWithTheirRow) {
    TriangleMesh mesh = shapes::cube();
    mesh.vertices[5].y = kNan;
    EXPECT_EQ(complaint(mesh), "vertex 5 has a coordinate that is not finite");
    mesh.vertices[5].y = -kInf;
    EXPECT_EQ(complaint(mesh), "vertex 5 has a coordinate that is not finite");
    mesh.vertices[5].y = 1e101;
    EXPECT_EQ(complaint(mesh), "vertex 5 has a coordinate beyond 1e100");
    mesh = shapes::cube();
    mesh.faces[7][2] = 8;
    EXPECT_EQ(complaint(mesh), "face 7 has vertex index 8, there are 8 vertices (rows from 0)");
    mesh.faces[7][2] = -1;
    EXPECT_EQ(complaint(mesh), "face 7 has vertex index -1, there are 8 vertices (rows from 0)");
    EXPECT_EQ(complaint({}), "the mesh has no faces with area");
    EXPECT_EQ(complaint({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}), "the mesh has no faces with area");
    for (const double distance : {-1.0, kNan, kInf})
        EXPECT_THROW(prepare_mesh(shapes::cube(), distance), InvalidInput);
}

TEST(Prepare, CleanMeshesStayAsTheyAre) {
    for (const TriangleMesh& mesh : {shapes::sphere(), shapes::torus(), shapes::cube(), shapes::cylinder()}) {
        const PreparedMesh prepared = prepare_mesh(mesh, 1e-6);
        EXPECT_EQ(prepared.mesh.vertices, mesh.vertices);
        EXPECT_EQ(prepared.mesh.faces, mesh.faces);
        EXPECT_EQ(prepared.diagonal, diagonal(mesh));
        ASSERT_EQ(prepared.islands.size(), 1u);
        const Island& island = prepared.islands[0];
        EXPECT_TRUE(island.closed && island.manifold && island.oriented);
        EXPECT_DOUBLE_EQ(island.area, surface_area(mesh));
        EXPECT_GT(island.signed_volume, 0);
    }
}

TEST(Prepare, WeldsExactCopiesAndSignsOfZero) {
    TriangleMesh mesh = shapes::soup(shapes::sphere(2));
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 2)
        for (int axis = 0; axis < 3; ++axis)
            if (mesh.vertices[i][axis] == 0) mesh.vertices[i][axis] = -0.0;
    const PreparedMesh prepared = prepare_mesh(mesh, 0);
    EXPECT_EQ(prepared.mesh.vertices.size(), 66u);
    EXPECT_EQ(prepared.defects.duplicate_vertices, 3 * 128 - 66);
    EXPECT_TRUE(prepared.islands.at(0).closed);
    // The order is that of first appearance.
    EXPECT_EQ(prepared.mesh.faces[0], (Triangle{0, 1, 2}));
}

TEST(Prepare, CountsAndRemovesWhatIsNoSurface) {
    TriangleMesh mesh = shapes::cube();
    mesh.vertices.push_back({9, 9, 9});         // unused
    mesh.vertices.push_back(mesh.vertices[0]);  // a copy
    mesh.faces.push_back({0, 9, 1});            // two corners equal after welding
    mesh.faces.push_back({3, 3, 5});
    mesh.vertices.insert(mesh.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}});
    mesh.faces.push_back({10, 11, 12});                                            // no area
    mesh.faces.push_back(mesh.faces[2]);                                           // again
    mesh.faces.push_back({mesh.faces[3][2], mesh.faces[3][1], mesh.faces[3][0]});  // again, turned over
    const PreparedMesh prepared = prepare_mesh(mesh, 0);
    EXPECT_EQ(prepared.defects.unused_vertices, 1);
    EXPECT_EQ(prepared.defects.duplicate_vertices, 1);
    EXPECT_EQ(prepared.defects.degenerate_faces, 3);
    EXPECT_EQ(prepared.defects.duplicate_faces, 2);
    EXPECT_EQ(prepared.mesh.vertices, shapes::cube().vertices);
    EXPECT_EQ(prepared.mesh.faces, shapes::cube().faces);
}

TEST(Prepare, CancelIsHeard) {
    CancelToken token;
    token.cancel();
    Task task;
    task.cancel = &token;
    EXPECT_THROW(prepare_mesh(shapes::sphere(), 0, task), Cancelled);
}

TEST(Prepare, ExtractedIslandsHaveTheirOwnVertices) {
    const TriangleMesh scene =
        shapes::joined(shapes::cube(1), shapes::translated(shapes::torus(), {9, 0, 0}));
    const PreparedMesh prepared = prepare_mesh(scene, 0);
    ASSERT_EQ(prepared.islands.size(), 2u);
    const TriangleMesh cube = extract_island(prepared, prepared.islands[0]);
    EXPECT_EQ(cube.vertices, shapes::cube().vertices);
    EXPECT_EQ(cube.faces, shapes::cube().faces);
    EXPECT_EQ(extract_island(prepared, prepared.islands[1]).faces, shapes::torus().faces);
}

}  // namespace
}  // namespace pfgeom
