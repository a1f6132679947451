#include "pfgeom/fit/tree_quadric.h"

#include "pfgeom/function/quadric_family.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <string>

namespace pfgeom {
namespace {

struct Patch {
    PowerSums sums;
    std::vector<CheckPoint> checks;
};

// The faces of a mesh whose centroid is where `wanted` says.
template <class Wanted>
Patch patch_of(const TriangleMesh& mesh, double limit, const Wanted& wanted) {
    Patch patch;
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        if (!wanted((a + b + c) / 3)) continue;
        patch.sums.add_triangle(a, b, c);
        for (const Vec3& p : {a, b, c, (a + b + c) / 3}) patch.checks.push_back({p, limit});
    }
    return patch;
}

constexpr int kResolution = 11;
constexpr double kLimit = 0.9e-3;

std::string family_found(Patch patch) {
    const auto found = quantise(patch.sums, patch.checks, kResolution, 40, kLimit * kLimit);
    if (!found) return "none";
    EXPECT_TRUE(passes(found->quadric.quadric, patch.checks));
    EXPECT_EQ(found->quadric.quadric, expand(found->quadric, kResolution));
    EXPECT_DOUBLE_EQ(found->bits, estimated_bits(found->quadric));
    return std::string(quadric_families()[found->quadric.family].name);
}

TEST(TreeQuadric, RecognisesTheSimplestFamily) {
    const auto all = [](const Vec3&) { return true; };
    const TriangleMesh cylinder = shapes::scaled(shapes::cylinder(200), {0.5, 0.5, 0.5});
    EXPECT_EQ(family_found(patch_of(cylinder, kLimit, [](const Vec3& p) { return p.z > 0.499; })),
              "plane across z");
    EXPECT_EQ(family_found(patch_of(cylinder, kLimit, [](const Vec3& p) { return std::abs(p.z) < 0.499; })),
              "round cylinder along z");
    EXPECT_EQ(family_found(patch_of(shapes::sphere(5, 0.6, {0.1, 0.2, 0}), kLimit, all)), "sphere");
    EXPECT_EQ(family_found(patch_of(shapes::ellipsoid({0.8, 0.5, 0.5}, 5), kLimit, all)),
              "revolution around x");
    EXPECT_EQ(family_found(patch_of(shapes::ellipsoid({0.8, 0.5, 0.6}, 5), kLimit, all)),
              "axes-parallel quadric");
}

TEST(TreeQuadric, TakesFewerBitsWhereItMayMissMore) {
    const auto all = [](const Vec3&) { return true; };
    Patch fine = patch_of(shapes::ellipsoid({0.8, 0.5, 0.6}, 5), 1e-3, all);
    Patch coarse = patch_of(shapes::ellipsoid({0.8, 0.5, 0.6}, 5), 1e-2, all);
    const auto a = quantise(fine.sums, fine.checks, 11, 40, 1e-6),
               b = quantise(coarse.sums, coarse.checks, 8, 40, 1e-6);
    ASSERT_TRUE(a && b);
    EXPECT_LT(b->bits, a->bits);
}

TEST(TreeQuadric, IsNoneWhereNoQuadricServes) {
    Patch patch = patch_of(shapes::cube(0.5), kLimit, [](const Vec3&) { return true; });
    EXPECT_FALSE(quantise(patch.sums, patch.checks, kResolution, 40, kLimit * kLimit));
}

TEST(TreeQuadric, RoundsFinelyToTheNearest) {
    const Quadric q{{0.5, -1.25, 0, 0.001, 0, 0, 1, -1, 0.3, 0.7}};
    const Quadric rounded = round_finely(q, 12).quadric;
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(rounded.c[i], q.c[i], std::ldexp(0.5, -12));
}

}  // namespace
}  // namespace pfgeom
