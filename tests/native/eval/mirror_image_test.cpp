#include "pfgeom/eval/mirror_image.h"

#include "pfgeom/eval/edge_axes.h"
#include "pfgeom/eval/mesh_part.h"
#include "polygonize/mesh_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

// The upper half of an octahedron on a grid of 1/1024, its plane at z = 1/4 of the cube.
Object half_octahedron(const Bulge& bulge) {
    MeshPart part;
    part.step_code = part.bulge_code = -80;
    part.positions = {{512, 0, 0}, {0, 512, 0}, {-512, 0, 0}, {0, -512, 0}, {0, 0, 400}};
    part.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    part.mirror = MirrorPlane{2, 0.25};
    const EdgesOfFaces edges = EdgesOfFaces::of(part.faces);
    for (const auto& ends : edges.ends)
        part.bulges.push_back({bulge.normal, part.is_seam(ends) ? 0 : bulge.sideways});
    Object object;
    object.shape = part;
    return object;
}

TEST(MirrorImage, JoinsTheHalvesToAClosedSurface) {
    for (const Bulge& bulge : {Bulge{}, Bulge{60, 0}, Bulge{-40, 25}}) {
        for (const double chord : {1.0, 1e-2, 1e-4}) {
            const TriangleMesh mesh = mesh_of(half_octahedron(bulge), {.chord = chord});
            EXPECT_TRUE(test::is_closed_manifold(mesh));
            EXPECT_EQ(test::euler_characteristic(mesh), 2);
        }
    }
    Object flat = half_octahedron({});
    std::get<MeshPart>(flat.shape).bulges.clear();
    const TriangleMesh mesh = mesh_of(flat, {});
    EXPECT_EQ(mesh.faces.size(), 8U);
    EXPECT_EQ(mesh.vertices.size(), 6U);
    EXPECT_TRUE(test::is_closed_manifold(mesh));
    EXPECT_EQ(mesh.vertices[5], (Vec3{0, 0, 0.25 - 400.0 / 1024}));
}

TEST(MirrorImage, EdgesOnThePlaneBulgeWithinIt) {
    const Object object = half_octahedron({60, 0});
    const auto& part = std::get<MeshPart>(object.shape);
    const EdgesOfFaces edges = EdgesOfFaces::of(part.faces);
    const std::vector<EdgeAxes> axes = edge_axes(part, edges);
    int seams = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!part.is_seam(edges.ends[i])) continue;
        ++seams;
        EXPECT_EQ(axes[i].faces, 2) << "with the image";
        EXPECT_EQ(axes[i].normal.z, 0);
        EXPECT_NEAR(norm(axes[i].normal), 1, 1e-15);
        EXPECT_LT(axes[i].fold, 1);
    }
    EXPECT_EQ(seams, 4);
    for (const Vec3& v : mesh_of(object, {.chord = 1e-3}).vertices)
        EXPECT_TRUE(v.z == 0.25 || std::abs(v.z - 0.25) > 1e-4) << v.z;
}

}  // namespace
}  // namespace pfgeom
