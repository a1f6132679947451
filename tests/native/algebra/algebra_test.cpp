#include "pfgeom/algebra/algebra.h"

#include "combinations.h"
#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/function/check.h"
#include "pfgeom/render/scene.h"
#include "polygonize/mesh_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

using test::ball;

std::vector<Vec3> random_points(std::uint64_t seed, int n) {
    Random random(seed);
    std::vector<Vec3> points;
    for (int i = 0; i < n; ++i)
        points.push_back(
            {test::between(random, -2, 2), test::between(random, -2, 2), test::between(random, -2, 2)});
    return points;
}

MeshOptions within(double tolerance) {
    MeshOptions options;
    options.tolerance = tolerance;
    return options;
}

TEST(Algebra, ValuesAreTheLargerAndSmallerOfTheOperandsExactly) {
    const std::vector<Model> models = test::closed_models();
    const std::vector<Vec3> points = random_points(1, 400);
    for (const Model& a : models) {
        for (const Model& b : models) {
            const ModelField fa(a), fb(b), unites(a | b), intersects(a & b), subtracts(a - b);
            for (const Vec3& p : points) {
                const double va = fa.value(p), vb = fb.value(p);
                ASSERT_EQ(unites.value(p), std::max(va, vb));
                ASSERT_EQ(intersects.value(p), std::min(va, vb));
                ASSERT_EQ(subtracts.value(p), std::min(va, -vb));
            }
        }
    }
}

TEST(Algebra, ImagesHaveTheValuesOfThePointsBefore) {
    Random random(5);
    for (const Model& model : test::closed_models()) {
        Similarity s = test::random_similarity(random);
        const ModelField before(model), after(transformed(model, s));
        for (const Vec3& p : random_points(2, 200)) {
            const double expected = s.scale * before.value(p);
            EXPECT_NEAR(after.value(s.apply(p)), expected, 1e-9 * (1 + std::abs(expected)));
        }
    }
}

TEST(Algebra, ShearedInsideIsTheInsideSheared) {
    Affine shear;
    shear.rows[0] = {2, 0.7, -0.3};
    const Model model = test::hierarchy_model(3);
    const ModelField before(model), after(transformed(model, shear));
    int inside = 0;
    for (const Vec3& p : random_points(3, 2000)) {
        if (std::abs(before.value(p)) < 1e-9) continue;
        EXPECT_EQ(after.contains(shear.apply(p)), before.contains(p));
        EXPECT_LE(std::abs(after.value(shear.apply(p))), 2.5 * std::abs(before.value(p)));
        inside += before.contains(p) ? 1 : 0;
    }
    EXPECT_GT(inside, 20);
}

TEST(Algebra, GradientsAreThoseOfTheValues) {
    const Model model = test::random_combination(4);
    const ModelField field(model);
    int compared = 0;
    for (const Vec3& p : random_points(4, 500)) {
        const Vec3 g = field.gradient(p);
        Vec3 measured;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 e;
            e[axis] = 1e-6;
            measured[axis] = (field.value(p + e) - field.value(p - e)) / 2e-6;
        }
        compared += norm(g - measured) < 0.05 * (norm(measured) + 1) ? 1 : 0;
    }
    EXPECT_GT(compared, 350);  // not at creases, and of trees only to first order
}

TEST(Algebra, FilesGiveTheSameValuesAndTheSameBytes) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const auto bytes = encode(test::random_combination(seed));
        const Result<Model> model = decode(bytes);
        ASSERT_TRUE(model) << seed;
        EXPECT_EQ(encode(*model), bytes) << seed;
        EXPECT_EQ(model->combination.steps.size(), 10U);
        const Result<Model> again = decode(encode(*model));
        const ModelField one(*model), two(*again);
        for (const Vec3& p : random_points(seed, 50)) ASSERT_EQ(one.value(p), two.value(p));
    }
}

TEST(Algebra, AnOperandThatIsMetAgainIsKeptOnce) {
    const Model a = test::tree_model(1), b = test::hierarchy_model(3);
    const Model c = ((a | b) - transformed(a, Affine{})) & b;
    EXPECT_EQ(c.combination.operands.size(), 2U);
    EXPECT_EQ(c.objects.size(), 2U);
    EXPECT_EQ(c.functions.size(), 1U);
    const Model moved = transformed(transformed(a, Affine{}), Affine{});
    EXPECT_EQ(moved.combination.transforms.size(), 1U);
}

TEST(Algebra, OpenSurfacesAreRefusedByNumber) {
    Model sheet = ball();
    sheet.objects[0].shape = Sheet{0, 0, {}};
    Model open = test::mesh_ball();
    std::get<MeshPart>(open.objects[0].shape).faces.pop_back();
    for (const Model& bad : {sheet, open}) {
        EXPECT_THROW(ball() | bad, InvalidInput);
        EXPECT_THROW(bad & ball(), InvalidInput);
        EXPECT_NO_THROW(transformed(bad, Affine{}));
    }
    try {
        ball() - sheet;
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("object 0 is an open surface"), std::string::npos);
    }
}

TEST(Algebra, MapsThatCannotBeInvertedAreRefused) {
    Affine flat;
    flat.rows[2] = flat.rows[1];
    Affine endless;
    endless.translation.x = std::nan("");
    Affine thin;
    thin.rows[0].x = 1e-8;
    for (const Affine& map : {flat, endless, thin}) EXPECT_THROW(transformed(ball(), map), InvalidInput);
}

TEST(Algebra, BoundsOfAnImageGrowWithIt) {
    Affine twice;
    for (Vec3& row : twice.rows) row *= 2;
    const Model image = transformed(ball(), twice);
    EXPECT_EQ(image.promise.bound_mesh, 2 * ball().promise.bound_mesh);
    EXPECT_TRUE(image.promise.certified);
    const Model both = ball() | image;  // nothing is known of its mesh
    EXPECT_EQ(both.promise.bound_mesh, 0);
    EXPECT_FALSE(both.promise.certified);
}

TEST(Algebra, MeshesAreClosedAndOnTheSurface) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const Model model = test::random_combination(seed);
        const TriangleMesh mesh = to_mesh(model, within(4e-3));
        ASSERT_FALSE(mesh.faces.empty()) << seed;
        EXPECT_TRUE(test::is_closed_manifold(mesh)) << seed;
        const ModelField field(model);
        std::vector<double> distances;
        for (const Vec3& v : mesh.vertices) distances.push_back(std::abs(field.value(v)));
        std::sort(distances.begin(), distances.end());
        EXPECT_LT(distances[distances.size() * 95 / 100], 4e-3) << seed;
    }
}

// Two balls of radius r = √½, one moved by d along x: the lens has a sharp rim.
TEST(Algebra, CreasesAreEdgesOfTheMesh) {
    Affine move;
    move.translation = {0.6, 0, 0};
    const TriangleMesh lens = to_mesh(ball() & transformed(ball(), move), within(2e-3));
    EXPECT_TRUE(test::is_closed_manifold(lens));
    const double rim = std::sqrt(0.5 - 0.09);
    int on_rim = 0;
    double most = 0;
    for (const Vec3& v : lens.vertices) {
        const double off = std::hypot(v.x - 0.3, std::sqrt(v.y * v.y + v.z * v.z) - rim);
        on_rim += off < 1e-6 ? 1 : 0;
        most = std::max(most, std::sqrt(v.y * v.y + v.z * v.z));
    }
    EXPECT_GT(on_rim, 12);
    EXPECT_NEAR(most, rim, 1e-4);
}

// A ray that changes sides must say so, at a place where the value is zero; between, nothing changes.
TEST(Algebra, RaysMeetTheSurfaceOfTheResult) {
    int hits = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const Model model = test::random_combination(seed);
        const ModelField field(model);
        const RayScene scene(model);
        Random random(seed + 100);
        for (int i = 0; i < 300; ++i) {
            const auto at = [&] {
                return Vec3{test::between(random, -3, 3), test::between(random, -3, 3), 3.0};
            };
            const Vec3 from = at(), to = -at();
            const Ray ray{from, to - from};
            const SurfaceHit hit = scene.first_hit(ray);
            const double end = hit.found() ? hit.t : 1.0;
            const bool starts = field.contains(from);
            for (int k = 1; k < 40; ++k) {
                const Vec3 p = ray.at(end * k / 40);
                if (std::abs(field.value(p)) <= 1e-6) continue;
                ASSERT_EQ(field.contains(p), starts) << seed << ' ' << i;
            }
            if (!hit.found()) continue;
            ++hits;
            EXPECT_LT(std::abs(field.value(ray.at(hit.t))), 2e-2) << seed << ' ' << i;
            EXPECT_EQ(dot(hit.normal, ray.direction) > 0, starts);
        }
    }
    EXPECT_GT(hits, 300);
}

TEST(Algebra, WhatIsTakenFromItselfIsNothing) {
    const Model nothing = ball() - ball();
    EXPECT_FALSE(RayScene(nothing).first_hit({{0.1, 0.2, 5}, {0, 0, -1}}).found());
    EXPECT_TRUE(to_mesh(nothing, within(1e-2)).faces.empty());
    EXPECT_TRUE(ModelField(nothing).value({0.1, 0, 0}) < 0);
}

// --- flaws
// ---------------------------------------------------------------------------------------------------

std::string flaw(void (*harm)(Combination&)) {
    Model model = ball() | test::tree_model(1);
    harm(model.combination);
    return find_flaw(model);
}

TEST(CombinationFlaw, IsNamed) {
    using Kind = CombinationStep::Kind;
    EXPECT_EQ(flaw([](Combination&) {}), "");
    EXPECT_NE(flaw([](Combination& c) { c.steps.pop_back(); }), "");
    EXPECT_NE(flaw([](Combination& c) { c.steps.push_back({Kind::unite, -1}); }), "");
    EXPECT_NE(flaw([](Combination& c) { c.steps.clear(); }), "");
    EXPECT_NE(flaw([](Combination& c) { c.steps[1].row = 0; }), "");
    EXPECT_NE(flaw([](Combination& c) { std::swap(c.steps[0], c.steps[1]); }), "");
    EXPECT_NE(flaw([](Combination& c) { c.operands[0].objects = 2; }), "");
    EXPECT_NE(flaw([](Combination& c) { c.operands[0].objects = -1; }), "");
    EXPECT_NE(flaw([](Combination& c) { c.operands.pop_back(); }), "");
    EXPECT_NE(flaw([](Combination& c) { c.operands[1].diagonal = 0; }), "");
    EXPECT_NE(flaw([](Combination& c) { c.transforms.emplace_back(); }), "");
    EXPECT_NE(flaw([](Combination& c) { c.steps.push_back({Kind::transform, 0}); }), "");
    EXPECT_NE(flaw([](Combination& c) {
                  for (int i = 0; i < 600; ++i) {
                      c.steps.push_back({Kind::operand, 0});
                      c.steps.push_back({Kind::unite, -1});
                  }
              }).find("512 deep"),
              std::string::npos);
}

}  // namespace
}  // namespace pfgeom
