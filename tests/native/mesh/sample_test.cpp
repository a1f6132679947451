#include "pfgeom/mesh/sample.h"

#include "pfgeom/base/error.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

TEST(SampleSurface, PointsLieOnTheirFaces) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    const SurfaceSamples samples = sample_surface(mesh, 5000, 1);
    ASSERT_EQ(samples.points.size(), 5000U);
    ASSERT_EQ(samples.faces.size(), 5000U);
    ASSERT_EQ(samples.barycentric.size(), 5000U);
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        const Vec3& w = samples.barycentric[i];
        EXPECT_TRUE(w.x >= 0 && w.y >= 0 && w.z >= 0);
        EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-15);
        const auto& [a, b, c] = mesh.faces[samples.faces[i]];
        const Vec3 p = mesh.vertices[a] * w.x + mesh.vertices[b] * w.y + mesh.vertices[c] * w.z;
        EXPECT_EQ(p, samples.points[i]);
    }
}

// One in each slice: the count on any face is within two of its share, which independent draws miss by far.
TEST(SampleSurface, EveryFaceGetsItsShareOfTheArea) {
    const TriangleMesh mesh = shapes::scaled(shapes::cube(), {1, 2, 5});
    const SurfaceSamples samples = sample_surface(mesh, 100'000, 7);
    std::vector<double> counts(mesh.faces.size());
    for (const std::int32_t face : samples.faces) ++counts[face];
    const double total = surface_area(mesh);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const auto& [a, b, c] = mesh.faces[f];
        const Vec3 ab = mesh.vertices[b] - mesh.vertices[a], ac = mesh.vertices[c] - mesh.vertices[a];
        EXPECT_NEAR(counts[f], norm(cross(ab, ac)) / 2 / total * 100'000, 2);
    }
}

TEST(SampleSurface, IntegratesALinearFunctionOverATriangle) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    Vec3 mean, square;
    const SurfaceSamples samples = sample_surface(mesh, 100'000, 3);
    for (const Vec3& p : samples.points) {
        mean += p * 1e-5;
        square += Vec3{p.x * p.x, p.x * p.y, 0} * 1e-5;
    }
    EXPECT_NEAR(mean.x, 1.0 / 3, 3e-3);
    EXPECT_NEAR(mean.y, 1.0 / 3, 3e-3);
    EXPECT_NEAR(square.x, 1.0 / 6, 3e-3);
    EXPECT_NEAR(square.y, 1.0 / 12, 3e-3);
}

TEST(SampleSurface, TheSeedDecides) {
    const TriangleMesh mesh = shapes::torus();
    EXPECT_EQ(sample_surface(mesh, 100, 1).points, sample_surface(mesh, 100, 1).points);
    EXPECT_NE(sample_surface(mesh, 100, 1).points, sample_surface(mesh, 100, 2).points);
}

TEST(SampleSurface, FacesWithoutAreaGetNone) {
    TriangleMesh mesh = shapes::cube();
    mesh.faces.insert(mesh.faces.begin(), {0, 0, 1});
    mesh.faces.push_back({2, 2, 2});
    for (const std::int32_t face : sample_surface(mesh, 10'000, 1).faces) {
        EXPECT_TRUE(face >= 1 && face <= 12);
    }
    EXPECT_THROW(sample_surface({mesh.vertices, {{0, 0, 1}}}, 10, 1), InvalidInput);
    EXPECT_THROW(sample_surface({}, 10, 1), InvalidInput);
    EXPECT_TRUE(sample_surface(mesh, 0, 1).points.empty());
}

TEST(VertexNormals, PointOutwardsOnASphere) {
    TriangleMesh mesh = shapes::sphere(4);
    mesh.vertices.push_back({9, 9, 9});
    const std::vector<Vec3> normals = vertex_normals(mesh);
    ASSERT_EQ(normals.size(), mesh.vertices.size());
    for (std::size_t v = 0; v + 1 < normals.size(); ++v) EXPECT_GT(dot(normals[v], mesh.vertices[v]), 0.999);
    EXPECT_EQ(normals.back(), (Vec3{}));
}

}  // namespace
}  // namespace pfgeom
