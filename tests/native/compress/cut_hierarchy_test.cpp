// Free forms that quadrics cut: a smooth body with bumps, flat below and with a hole drilled through it.
#include "pfgeom/compress/candidate.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/eval/solid_field.h"
#include "pfgeom/fit/cuts.h"
#include "pfgeom/fit/quadric.h"
#include "pfgeom/mesh/islands.h"
#include "pfgeom/mesh/sample.h"
#include "pfgeom/polygonize/polygonize.h"
#include "polygonize/mesh_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

constexpr Quadric kFloor{{0, 0, 0, 0, 0, 0, 0, 0, 1, 0.4}};              // z >= -0.4
constexpr Quadric kHole{{3.2, 3.2, 0, 0, 0, 0, -0.32, 0, 0, -0.094}};    // 0.2 around x = 0.05, y = 0
constexpr Quadric kBody{{-1.3, -1.8, -2.4, 0.3, 0, 0.2, 0, 0, 0, 0.6}};  // an ellipsoid

SetNode operand(std::int32_t function) {
    return {.kind = SetNode::Kind::function, .a = function};
}

SetNode both(std::int32_t a, std::int32_t b) {
    return {.kind = SetNode::Kind::intersect, .a = a, .b = b};
}

Model machined_model() {
    Model model;
    model.functions.resize(3);
    model.functions[0].base = kBody;
    for (int i = 0; i < 12; ++i) {
        const double x = 0.55 * ((i % 4) - 1.5) / 1.5, y = 0.4 * ((i / 4) - 1), z = i % 2 == 0 ? 0.4 : 0.1;
        constexpr double k = 1 / (0.3 * 0.3);
        const Quadric ball{
            {-k, -k, -k, 0, 0, 0, 2 * k * x, 2 * k * y, 2 * k * z, 1 - k * (x * x + y * y + z * z)}};
        model.functions[0].perturbations.push_back({i % 3 == 0 ? -0.07 : 0.09, ball});
    }
    model.functions[1].base = kFloor;
    model.functions[2].base = kHole;
    model.objects.resize(1);
    model.objects[0].shape = Solid{{operand(0), operand(1), both(0, 1), operand(2), both(2, 3)}};
    return model;
}

TriangleMesh machined(double tolerance = 4e-4) {
    const Model model = machined_model();
    return polygonize(model, std::get<Solid>(model.objects[0].shape),
                      {.tolerance = tolerance, .min_depth = 3});
}

void expect_one_closed_manifold(const TriangleMesh& mesh) {
    EXPECT_TRUE(test::is_closed_manifold(mesh));
    EXPECT_EQ(find_pieces(mesh).size(), 1U);
}

double farthest_on(const Quadric& q, const TriangleMesh& mesh, const Cut& cut) {
    double most = 0;
    for (const std::int32_t f : cut.faces)
        for (const std::int32_t v : mesh.faces[f])
            most = std::max(most, first_order_distance(q, mesh.vertices[v]));
    return most;
}

TEST(PolygonizeSolid, MeetsCreasesExactly) {
    const double tolerance = 4e-4;
    const TriangleMesh mesh = machined(tolerance);
    expect_one_closed_manifold(mesh);
    const Model model = machined_model();
    const SolidField field(model, std::get<Solid>(model.objects[0].shape));
    int on_floor = 0, in_hole = 0;
    for (const Vec3& v : mesh.vertices) {
        Vec3 gradient;
        const double value = field.value_and_gradient(v, gradient);
        EXPECT_LE(std::abs(value), tolerance * norm(gradient));
        on_floor += std::abs(kFloor.value(v)) < 1e-6;
        in_hole += std::abs(kHole.value(v)) < 1e-4;
    }
    EXPECT_GT(on_floor, 50);
    EXPECT_GT(in_hole, 50);
}

TEST(FindCuts, FlatFacesAndHoles) {
    const TriangleMesh mesh = machined();
    const double tolerance = 1e-3;
    const std::vector<Cut> cuts = find_cuts(mesh, tolerance, 1e-6);
    ASSERT_EQ(cuts.size(), 2U);
    EXPECT_LT(farthest_on(kHole, mesh, cuts[0]), 1e-3);
    EXPECT_LT(farthest_on(kFloor, mesh, cuts[1]), 1e-4);
    for (const Cut& cut : cuts) {
        EXPECT_LE(farthest_on(cut.quadric, mesh, cut), tolerance);
        EXPECT_GT(cut.quadric.value({0.5, 0.2, 0.1}), 0) << "positive inside";
    }
}

TEST(FindCuts, NoneOfASmoothForm) {
    EXPECT_TRUE(find_cuts(shapes::bumpy_sphere(4), 1e-2, 1e-6).empty());
    EXPECT_TRUE(find_cuts(shapes::torus(0.7, 0.2, 64, 32), 1e-3, 1e-6).empty());
}

// Of the large cube the side towards the small one would cut that off; of the small one all but the far side
// would cut the large one.
TEST(FindCuts, NoneThatWouldCutMore) {
    TriangleMesh two = shapes::cube(0.3);
    shapes::append(two, shapes::cube(0.2, {0.6, 0, 0}));
    const std::vector<Cut> cuts = find_cuts(two, 1e-3, 1e-6);
    EXPECT_EQ(cuts.size(), 6U);
    for (const Cut& cut : cuts)
        for (const Vec3& v : two.vertices) EXPECT_GE(cut.quadric.value(v), -1e-3);
}

TEST(CutHierarchy, TakesFewerBytesAndKeepsItsCreases) {
    const TriangleMesh input = machined(1e-3);
    const Bvh bvh(input);
    const Goal goal{input, bvh, 1e-3 * diagonal(input), Metric::rms, diagonal(input)};
    const std::optional<Outcome> cut = try_cut_hierarchy(goal, kAnyBytes, {});
    const std::optional<Outcome> plain = try_hierarchy(goal, kAnyBytes, {});
    ASSERT_TRUE(cut && cut->holds);
    ASSERT_TRUE(plain);
    EXPECT_LT(cut->bytes, 0.85 * static_cast<double>(plain->bytes));
    EXPECT_LT(cut->deviation.max(), plain->deviation.max());
    EXPECT_EQ(cut->functions.size(), 3U);
    expect_one_closed_manifold(cut->mesh);

    const Model model = model_of(goal, *cut);
    const ModelField field(model);
    int decided = 0;
    for (const Vec3& p : sample_surface(input, 2000, 3).points) {
        const Vec3 out = p * 1.1, in = p * 0.9;
        for (const Vec3& q : {out, in}) {
            if (bvh.closest(q).squared_distance < 1e-4) continue;
            ++decided;
            EXPECT_EQ(field.contains(q), std::abs(bvh.winding_number(q)) > 0.5);
        }
    }
    EXPECT_GT(decided, 1000);
}

TEST(CutHierarchy, NotOfASmoothFormNorOfAPart) {
    for (const TriangleMesh& mesh : {shapes::bumpy_sphere(4), shapes::cylinder(64), shapes::cube()}) {
        const Bvh bvh(mesh);
        const Goal goal{mesh, bvh, 1e-3 * diagonal(mesh), Metric::rms, diagonal(mesh)};
        EXPECT_FALSE(try_cut_hierarchy(goal, kAnyBytes, {}));
    }
}

}  // namespace
}  // namespace pfgeom
