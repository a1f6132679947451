#include "pfgeom/mesh/close_holes.h"

#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/prepare.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

// A sphere without the faces around some of its vertices.
TriangleMesh with_holes(std::initializer_list<std::int32_t> vertices) {
    TriangleMesh mesh = shapes::sphere(3);
    std::erase_if(mesh.faces, [&](const Triangle& t) {
        return std::ranges::any_of(vertices,
                                   [&](std::int32_t v) { return t[0] == v || t[1] == v || t[2] == v; });
    });
    return mesh;
}

TEST(CloseHoles, MakesAClosedManifoldOfAnIslandWithBorders) {
    const TriangleMesh open = with_holes({0, 100, 200});
    const ClosedIsland closed = close_holes(open);
    EXPECT_EQ(closed.own_faces, open.faces.size());
    EXPECT_TRUE(std::equal(open.faces.begin(), open.faces.end(), closed.mesh.faces.begin()));
    EXPECT_EQ(closed.mesh.vertices.size(), open.vertices.size() + 3);
    const PreparedMesh prepared = prepare_mesh(closed.mesh, 0);
    ASSERT_EQ(prepared.islands.size(), 1U);
    const Island& island = prepared.islands[0];
    EXPECT_TRUE(island.closed && island.manifold && island.oriented);
    EXPECT_GT(island.signed_volume, 0);
}

TEST(CloseHoles, LeavesWhatIsClosed) {
    const TriangleMesh sphere = shapes::sphere(2);
    const ClosedIsland closed = close_holes(sphere);
    EXPECT_EQ(closed.mesh.faces, sphere.faces);
    EXPECT_EQ(closed.own_faces, sphere.faces.size());
}

}  // namespace
}  // namespace pfgeom
