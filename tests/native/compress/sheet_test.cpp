// Open islands of one quadric: its zero set, cut by another one's.
#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/mesh/close_holes.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/prepare.h"
#include "pfgeom/mesh/weld.h"
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

// How many borders it has.
int borders(const TriangleMesh& mesh) {
    const ClosedIsland closed = close_holes(mesh);
    return static_cast<int>(closed.mesh.vertices.size() - mesh.vertices.size());
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

// A bumpy ball with two holes: where it is, functions; where its borders are, planes.
TriangleMesh blob_with_holes(int rounds) {
    TriangleMesh mesh = shapes::bumpy_sphere(rounds);
    std::erase_if(mesh.faces, [&](const Triangle& t) {
        const Vec3 p = normalized(mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
        return p.z > 0.95 || p.x < -0.9;
    });
    compact_vertices(mesh);
    return mesh;
}

Model as_cut_sheet(const TriangleMesh& mesh, double tolerance, const Task& task = {}) {
    const Bvh bvh(mesh);
    const double size = diagonal(mesh);
    const Goal goal{mesh, bvh, tolerance * size, Metric::rms, size, false, Effort::fast};
    const std::optional<Outcome> found = try_open_hierarchy(goal, 1U << 20, task);
    EXPECT_TRUE(found && found->holds);
    return found ? model_of(goal, *found) : Model{};
}

TEST(Sheet, AFreeFormWithHolesIsCutOutOfAClosedOne) {
    const TriangleMesh input = blob_with_holes(3);
    const Model model = as_cut_sheet(input, 2e-3);
    const FunctionCount count = count_functions(model);
    EXPECT_EQ(count.surface, 1);
    EXPECT_GT(count.perturbations, 10);
    EXPECT_GE(count.separators, 2);
    const ModelField field(model);
    EXPECT_LT(field.value({0, 0, 0}), 0) << "it has no inside";
    for (const MeshOptions& options : {MeshOptions{}, MeshOptions{{}, 60}, MeshOptions{{}, 200}}) {
        const TriangleMesh mesh = to_mesh(model, options);
        EXPECT_LE(measure_deviation(input, mesh).rms(), 2.5e-3 * diagonal(input));
        const PreparedMesh prepared = prepare_mesh(mesh, 0);
        ASSERT_EQ(prepared.islands.size(), 1U);
        EXPECT_TRUE(prepared.islands[0].manifold && prepared.islands[0].oriented);
        EXPECT_EQ(borders(mesh), 2);
        for (const Vec3& p : mesh.vertices) EXPECT_NEAR(field.value(p), 0, 1e-2);
    }
}

TEST(Sheet, ACutOneDoesNotDependOnThreads) {
    const TriangleMesh input = blob_with_holes(3);
    EXPECT_EQ(encode(as_cut_sheet(input, 2e-3, {1, nullptr, {}})),
              encode(as_cut_sheet(input, 2e-3, {3, nullptr, {}})));
}

TEST(Sheet, AFreeFormWithHolesTakesFewestBytesCut) {
    const TriangleMesh input = blob_with_holes(4);
    const CompressOptions options{.tolerance = 1e-3, .metric = Metric::rms, .effort = Effort::fast};
    const Compressed c = compress(input, options);
    EXPECT_EQ(c.report.islands.at(0).candidate, "sheet");
    EXPECT_LE(measure_deviation(input, to_mesh(*decode(c.bytes))).rms(), 1e-3 * diagonal(input));
}

// z = 1/4 in the cube, where `cut` keeps it.
Model cut_plane(const MaterialTree& cut) {
    Model model;
    model.diagonal = 2;
    model.functions.resize(1);
    model.functions[0].base = {{0, 0, 0, 0, 0, 0, 0, 0, -1, 0.25}};
    model.objects.emplace_back();
    model.objects[0].shape = Sheet{0, -1, cut};
    model.objects[0].mesh_code = 36;
    return model;
}

// The polygonizer closes a surface that leaves the cube; those sides are none of it.
TEST(Sheet, SidesOfTheCubeAreNoSurface) {
    const Model model = cut_plane(plain_paint(Sheet::kKept).trees.front());
    const TriangleMesh mesh = to_mesh(model);
    EXPECT_NEAR(surface_area(mesh), 4, 0.2);
    const double chord = 2 * exp2_eighths(-72);
    for (const Vec3& v : mesh.vertices) EXPECT_NEAR(v.z, 0.25, chord);
}

// Half of the plane, and a square an eighth wide far from it.
TEST(Sheet, CrumbsAreNoSurface) {
    MaterialTree cut;
    Box cell = root_cell();
    for (int i = 0; i < 8; ++i) {
        MaterialNode half;
        half.axis = i < 4 ? 0 : 1;
        const auto row = static_cast<std::int32_t>(cut.nodes.size());
        half.high = row + 1, half.low = row + 2;
        derive(half, cell);
        cell = low_cell(half, cell);
        cut.nodes.push_back(half);
        cut.nodes.emplace_back().material = row == 0 ? Sheet::kKept : Sheet::kCut;
    }
    cut.nodes.emplace_back().material = Sheet::kKept;
    for (const int resolution : {40, 200}) {
        const TriangleMesh mesh = to_mesh(cut_plane(cut), {{}, resolution});
        EXPECT_NEAR(surface_area(mesh), 2, 0.1);
        for (const Vec3& v : mesh.vertices) EXPECT_GT(v.x, -0.01);
    }
}

TEST(Sheet, PerturbationsAreRefusedByName) {
    Model model = compressed(tube()).model;
    model.functions[0].perturbations.emplace_back();
    EXPECT_THROW(to_mesh(model), InvalidInput);
}

}  // namespace
}  // namespace pfgeom
