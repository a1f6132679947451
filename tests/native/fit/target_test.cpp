#include "pfgeom/fit/target.h"

#include "pfgeom/mesh/sample.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfgeom {
namespace {

constexpr std::uint64_t kSeedOfProofs = 1;  // DeviationOptions::seed as it is by default

// At the samples that a function is fitted to its error is smaller than between them.
TEST(FitTarget, NotFittedToTheSamplesThatProveIt) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    const FitTarget target(mesh, 2000);
    for (const Vec3& p : sample_surface(in_cube(mesh, target.frame), 2000, kSeedOfProofs).points)
        EXPECT_EQ(std::ranges::count(target.points, p), 0);
}

TEST(FitTarget, WhatClosesASurfaceGetsFewSamplesOrNone) {
    TriangleMesh mesh = shapes::cube();
    std::stable_partition(mesh.faces.begin(), mesh.faces.end(), [&](const Triangle& t) {
        return std::ranges::any_of(t, [&](std::int32_t v) { return mesh.vertices[v].z < 0; });
    });
    const FitTarget target(mesh, 2000, 10, false);  // all but the two of the top
    EXPECT_GT(target.points.size(), 1500U);
    const auto on_top = [](const FitTarget& t) {
        return std::ranges::count_if(t.points,
                                     [&](const Vec3& p) { return t.frame.to_world(p).z > 1 - 1e-9; });
    };
    EXPECT_EQ(on_top(target), 0);
    const auto few = on_top(FitTarget(mesh, 2000, 10));
    EXPECT_GT(few, 10);
    EXPECT_LT(few, 50);
}

}  // namespace
}  // namespace pfgeom
