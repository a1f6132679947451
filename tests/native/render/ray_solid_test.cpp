#include "pfgeom/render/ray_solid.h"

#include "brute_force.h"
#include "codec/random_model.h"
#include "pfgeom/eval/solid_field.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using Kind = SetNode::Kind;

const Frame kUnit{};
const Box kCube{{-1, -1, -1}, {1, 1, 1}};
const Solid kAlone{{{Kind::function, 0, -1, -1}}};

// Ten coefficients of the order of one.
Quadric any_quadric(Random& random) {
    Quadric q;
    for (double& c : q.c) c = test::between(random, -1, 1);
    return q;
}

// Of both kinds of perturbations.
Function bumpy(Random& random, int last_level) {
    Function function = test::random_hierarchy(random, last_level);
    function.perturbations.push_back({0.3, {{-4, -5, -6, 0, 0, 0, 1, 0, 2, 0.2}}});
    return function;
}

test::Comparison compare(const Model& model, const Solid& solid, std::uint64_t seed, int rays, int steps) {
    const RaySolid target(model, solid, kUnit, {});
    const SolidField field(model, solid);
    const auto inside = [&](const Vec3& p) { return kCube.contains(p) && field.value(p) >= 0; };
    return test::compare(target, inside, kCube, seed, rays, steps);
}

TEST(RaySolid, AsBruteForceOnHierarchies) {
    Random random(8);
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        Model model;
        model.functions = {bumpy(random, 4)};
        const auto found = compare(model, kAlone, seed, 3000, 400);
        EXPECT_EQ(found.missed, 0);
        EXPECT_EQ(found.untrue, 0);
        EXPECT_GT(found.hits, 500);
    }
}

TEST(RaySolid, AsBruteForceOnQuadrics) {
    Random random(9);
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Model model;
        model.functions.emplace_back();
        model.functions[0].base = any_quadric(random);
        const auto found = compare(model, kAlone, seed, 500, 400);
        EXPECT_EQ(found.missed, 0) << seed;
        EXPECT_EQ(found.untrue, 0) << seed;
    }
}

// Of every kind of node, with functions that are asked more than once.
Solid random_expression(Random& random, int functions, int count) {
    Solid solid;
    for (std::int32_t i = 0; i < count; ++i) {
        const auto any = [&](std::int32_t n) {
            return static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(n)));
        };
        SetNode node{i < 2 ? Kind::function : static_cast<Kind>(any(7)), -1, -1, -1};
        const bool pair =
            node.kind == Kind::unite || node.kind == Kind::intersect || node.kind == Kind::decide;
        if (node.kind == Kind::function) node.a = any(functions);
        if (node.kind == Kind::complement || pair) node.a = any(i);
        if (pair) node.b = any(i);
        if (node.kind == Kind::decide) node.f = any(functions);
        solid.nodes.push_back(node);
    }
    return solid;
}

// An outer complement is its operand's surface; the slow twin sees the same changes but at the cube's sides.
TEST(RaySolid, AsBruteForceOnSetExpressions) {
    Random random(10);
    int hits = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Model model;
        for (int i = 0; i < 3; ++i) {
            model.functions.push_back(bumpy(random, 2));
            model.functions.back().base = any_quadric(random);
        }
        Solid solid = random_expression(random, 3, 7);
        while (solid.nodes.back().kind == Kind::complement) solid.nodes.pop_back();
        const auto found = compare(model, solid, seed, 300, 400);
        EXPECT_EQ(found.missed, 0) << seed;
        EXPECT_EQ(found.untrue, 0) << seed;
        hits += found.hits;
    }
    EXPECT_GT(hits, 2000);
}

TEST(RaySolid, ComplementHasTheSameSurface) {
    Random random(11);
    Model model;
    model.functions = {bumpy(random, 4)};
    const RaySolid plain(model, kAlone, kUnit, {});
    const RaySolid turned(model, Solid{{{Kind::function, 0, -1, -1}, {Kind::complement, 0, -1, -1}}}, kUnit,
                          {});
    for (int i = 0; i < 500; ++i) {
        const Ray ray = test::random_ray(random, kCube);
        EXPECT_EQ(plain.first_hit(ray, {}).t, turned.first_hit(ray, {}).t);
    }
}

TEST(RaySolid, SheetEndsAtItsTrim) {
    Model model;
    model.functions.resize(2);
    model.functions[0].base = {{0, 0, 0, 0, 0, 0, 0, 0, -1, 0.25}};   // z = 1/4
    model.functions[1].base = {{-1, -1, 0, 0, 0, 0, 0, 0, 0, 0.25}};  // within a circle of radius 1/2
    const RaySolid target(model, Sheet{0, 1, {}}, kUnit, {});
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = test::random_ray(random, kCube);
        const double t = (0.25 - ray.origin.z) / ray.direction.z;
        const Vec3 p = ray.at(t);
        const double within = 0.25 - p.x * p.x - p.y * p.y;
        if (!(std::abs(within) > 1e-6) || !(std::abs(t) > 1e-6)) continue;
        const SurfaceHit hit = target.first_hit(ray, {});
        ASSERT_EQ(hit.found(), t > 0 && within > 0) << i;
        if (!hit.found()) continue;
        EXPECT_NEAR(hit.t, t, 1e-9);
        EXPECT_NEAR(hit.normal.z, 1, 1e-12);
        EXPECT_EQ(hit.function, 0);
    }
}

// A bumpy ball, cut by random planes.
TEST(RaySolid, SheetEndsWhereItIsCut) {
    int hits = 0, misses = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        Model model;
        model.functions = {bumpy(random, 4)};
        Sheet sheet{0, -1, {}};
        test::grow_material_tree(random, root_cell(), 5, 2, sheet.cut);
        const RaySolid cut(model, sheet, kUnit, {}), whole(model, kAlone, kUnit, {});
        for (int i = 0; i < 300; ++i) {
            const Ray ray = test::random_ray(random, kCube);
            RaySpan span;
            SurfaceHit expected;  // the first hit of the whole that is kept
            for (int crossing = 0; crossing < 20; ++crossing) {
                const SurfaceHit hit = whole.first_hit(ray, span);
                if (!hit.found()) break;
                if (hit.function == 0 && material_at(sheet.cut, ray.at(hit.t)) == Sheet::kKept) {
                    expected = hit;
                    break;
                }
                span.from = hit.t + 1e-9;
            }
            const SurfaceHit hit = cut.first_hit(ray, {});
            ASSERT_EQ(hit.found(), expected.found()) << seed << " " << i;
            (hit.found() ? hits : misses) += 1;
            if (!hit.found()) continue;
            EXPECT_NEAR(hit.t, expected.t, 1e-9);
            EXPECT_EQ(hit.function, 0);
        }
    }
    EXPECT_GT(hits, 300);
    EXPECT_GT(misses, 300);
}

// Functions whose ranges never exclude zero, since two huge perturbations cancel: no cell prunes any of them,
// and the octree stays as coarse as its budget.
TEST(RaySolid, MemoryIsBounded) {
    constexpr std::int32_t kFunctions = 100;
    Model model;
    Solid solid;
    for (std::int32_t i = 0; i < kFunctions; ++i) {
        const Quadric everywhere{{0, 0, 0, 0, 0, 0, 0.1, 0, 0, 2.0 + i}};
        model.functions.push_back(
            {{{0, 0, 0, 0, 0, 0, 0, 0, 0, -1}}, {{1e30, everywhere}, {-1e30, everywhere}}, {}, {}});
        solid.nodes.push_back({Kind::function, i, -1, -1});
        const auto last = static_cast<std::int32_t>(solid.nodes.size()) - 1;
        if (i > 0) solid.nodes.push_back({Kind::unite, last - 1, last, -1});
    }
    const RaySolid target(model, solid, kUnit, {});
    EXPECT_EQ(target.leaf_count(), 4096U);
    // In doubles the huge ones leave zero, which is inside: the cube's side is the surface.
    EXPECT_DOUBLE_EQ(target.first_hit({{-3, 0.1, 0.2}, {1, 0, 0}}, {}).t, 2);
}

// What is left of a function in a cell has its bits, and its range holds.
TEST(CellFunction, SameBitsAndAConservativeRange) {
    Random random(12);
    const Function function = bumpy(random, 5);
    const FunctionTerms terms(function);
    const FunctionField field(function);
    std::vector<std::int32_t> all(terms.count());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
    for (int i = 0; i < 300; ++i) {
        const Vec3 centre = test::any_point(random);
        const double half = std::ldexp(1.0, -static_cast<int>(random.below(9)));
        const Box box{centre - Vec3{half, half, half}, centre + Vec3{half, half, half}};
        const CellFunction cell = look_at_cell(terms, all, box);
        for (int k = 0; k < 20; ++k) {
            const Vec3 p = centre + half * test::any_point(random),
                       q = centre + half * test::any_point(random);
            const Jet jet = field.jet(p), here = terms.jet(p, cell.live);
            EXPECT_EQ(terms.value(p, cell.live), field.value(p));
            EXPECT_EQ(here.value, jet.value);
            EXPECT_EQ(here.gradient, jet.gradient);
            EXPECT_GE(jet.value, cell.range.lo);
            EXPECT_LE(jet.value, cell.range.hi);
            EXPECT_LE(norm(field.jet(q).gradient - jet.gradient),
                      cell.bend * norm(q - p) * (1 + 1e-9) + 1e-12);
        }
    }
}

}  // namespace
}  // namespace pfgeom
