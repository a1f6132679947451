// Open islands of one quadric: its zero set, cut by another one's.
#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/mesh/edges.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

// A strip that closes around: point(turn, along), both from 0 to 1.
template <class Point>
TriangleMesh strip(const Point& point, std::int32_t around = 64, std::int32_t along = 24) {
    TriangleMesh mesh;
    for (std::int32_t i = 0; i < around; ++i)
        for (std::int32_t j = 0; j <= along; ++j)
            mesh.vertices.push_back(point(static_cast<double>(i) / around, static_cast<double>(j) / along));
    const auto at = [&](std::int32_t i, std::int32_t j) { return i % around * (along + 1) + j; };
    for (std::int32_t i = 0; i < around; ++i)
        for (std::int32_t j = 0; j < along; ++j) {
            mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

TriangleMesh tube() {
    return strip([](double turn, double along) {
        const auto [c, s] = shapes::on_circle(turn);
        return Vec3{c, s, 3 * along};
    });
}

// An ellipsoid between two parallel planes.
TriangleMesh barrel() {
    return strip([](double turn, double along) {
        const auto [c, s] = shapes::on_circle(turn);
        const auto [r, z] = shapes::on_circle(0.2 * along - 0.05);
        return Vec3{1.4 * r * c, 1.2 * r * s, 2 * z};
    });
}

std::vector<Vec3> border(const TriangleMesh& mesh) {
    std::vector<Vec3> points;
    for (const std::int32_t side : EdgeTable(mesh.faces, mesh.vertices.size()).boundary())
        points.push_back(mesh.vertices[mesh.faces[side / 3][side % 3]]);
    return points;
}

Compressed compressed(const TriangleMesh& mesh) {
    return compress(mesh, {.tolerance = 1e-3});
}

TEST(Sheet, OpenQuadricsTakeTwoFunctionsAndFewBytes) {
    for (const TriangleMesh& mesh : {tube(), barrel(), shapes::flipped(tube())}) {
        const Compressed c = compressed(mesh);
        EXPECT_EQ(c.report.islands.at(0).candidate, "sheet");
        EXPECT_LT(c.bytes.size(), 60U);
        EXPECT_TRUE(c.model.promise.certified);
        const FunctionCount count = count_functions(c.model);
        EXPECT_EQ(count.surface, 1);
        EXPECT_EQ(count.separators, 1);
        const Deviation d = measure_deviation(mesh, to_mesh(*decode(c.bytes)));
        EXPECT_LE(d.max(), c.model.promise.tolerance);
        EXPECT_LT(d.normals().mean, 5) << "the faces look the same way";
    }
}

TEST(Sheet, TheBorderIsClean) {
    const TriangleMesh mesh = to_mesh(compressed(tube()).model);
    const std::vector<Vec3> points = border(mesh);
    ASSERT_GT(points.size(), 40U);
    for (const Vec3& p : points) {
        EXPECT_LT(std::min(std::abs(p.z), std::abs(p.z - 3)), 2e-3);
        EXPECT_NEAR(p.x * p.x + p.y * p.y, 1, 4e-3);
    }
}

TEST(Sheet, HasNoInside) {
    const ModelField field(compressed(tube()).model);
    EXPECT_LT(field.value({0, 0, 1.5}), -0.01);
    EXPECT_LT(field.value({2, 0, 1.5}), -0.01);
    EXPECT_LT(field.value({1, 0, 4}), -0.01) << "beyond the trim";
    EXPECT_NEAR(field.value({1, 0, 1.5}), 0, 5e-3);
}

TEST(Sheet, StandsBesideSolids) {
    const TriangleMesh scene = shapes::joined(tube(), shapes::sphere(4, 0.5, {0, 0, 1.5}));
    const Compressed c = compressed(scene);
    EXPECT_EQ(count_functions(c.model).surface, 2);
    EXPECT_EQ(count_functions(c.model).separators, 1);
    EXPECT_TRUE(c.model.promise.certified);
    EXPECT_GT(ModelField(c.model).value({0, 0, 1.5}), 0.1) << "the ball has an inside";
}

// A border that no quadric cuts, and a quadric's border on another shape.
TEST(Sheet, OtherOpenShapesAreMeshParts) {
    for (const TriangleMesh& mesh : {shapes::saddle(8), shapes::moebius(24)}) {
        const Compressed c = compressed(mesh);
        const auto* part = std::get_if<MeshPart>(&c.model.objects.at(0).shape);
        ASSERT_NE(part, nullptr);
        EXPECT_EQ(c.report.islands.at(0).candidate, part->curved() ? "patches" : "mesh");
    }
}

TEST(Sheet, PerturbationsAreRefusedByName) {
    Model model = compressed(tube()).model;
    model.functions[0].perturbations.emplace_back();
    EXPECT_THROW(to_mesh(model), InvalidInput);
}

}  // namespace
}  // namespace pfgeom
