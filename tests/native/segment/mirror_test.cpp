#include "pfgeom/segment/mirror.h"

#include "placed_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

std::optional<Mirror> mirror_of(const TriangleMesh& mesh, double share) {
    return find_mirror(mesh, Bvh(mesh), share * diagonal(mesh), {});
}

TEST(Mirror, AnAxisIsFoundExactly) {
    const auto mirror = mirror_of(shapes::translated(shapes::casting(), {3, 1, -2}), 1e-3);
    ASSERT_TRUE(mirror);
    EXPECT_EQ(mirror->normal, (Vec3{1, 0, 0}));
    EXPECT_NEAR(mirror->at, 3, 1e-6);
    EXPECT_LT(mirror->deviation, 1e-6);
}

TEST(Mirror, IsFoundHoweverAShapeIsTurned) {
    Random random(5);
    for (int i = 0; i < 8; ++i) {
        const Similarity place = shapes::random_place(random, 3);
        const TriangleMesh mesh = shapes::placed(shapes::casting(), place);
        const auto mirror = mirror_of(mesh, 1e-3);
        ASSERT_TRUE(mirror);
        EXPECT_LT(mirror->deviation, 1e-5 * diagonal(mesh));
        EXPECT_NEAR(std::abs(dot(mirror->normal, place.turn({1, 0, 0}))), 1, 1e-9);
        EXPECT_NEAR(dot(mirror->normal, place.translation), mirror->at, 1e-4 * diagonal(mesh));
    }
}

TEST(Mirror, PlanesBetweenTheAxesAreFound) {
    const auto mirror = mirror_of(shapes::saddle(), 1e-3);  // x and y can be exchanged
    ASSERT_TRUE(mirror);
    EXPECT_NEAR(std::abs(mirror->normal.x), std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(std::abs(mirror->normal.y), std::sqrt(0.5), 1e-9);
}

TEST(Mirror, WhatIsNotSymmetricDoesNotBendThePlane) {
    TriangleMesh mesh = shapes::casting();
    const double size = diagonal(mesh);
    double widest = 0;
    for (const Vec3& v : mesh.vertices) widest = std::max(widest, v.x);
    for (Vec3& v : mesh.vertices) v.x += 1.5e-3 * size * std::max(0.0, (v.x / widest - 0.9) / 0.1);
    EXPECT_FALSE(mirror_of(mesh, 5e-4));
    const auto mirror = mirror_of(mesh, 2e-3);
    ASSERT_TRUE(mirror);
    EXPECT_EQ(mirror->normal, (Vec3{1, 0, 0}));
    EXPECT_NEAR(mirror->at, 0, 1e-4 * size);
    EXPECT_GT(mirror->deviation, 5e-4 * size);
}

// All vertices have images on the surface: the rims of the hole are on flat sides.
TEST(Mirror, AHoleInOneHalfAloneIsSeen) {
    const TriangleMesh box = shapes::scaled(shapes::cube(), {3, 2, 0.5});
    EXPECT_TRUE(mirror_of(box, 1e-3));
    const TriangleMesh bore = shapes::scaled(shapes::cylinder(), {0.2, 0.2, 0.5});
    TriangleMesh wall = shapes::translated(shapes::flipped(bore), {1.3, 0.8, 0});
    std::erase_if(wall.faces, [&](const Triangle& t) {
        const auto z = [&](std::size_t k) { return wall.vertices[static_cast<std::size_t>(t[k])].z; };
        return z(0) == z(1) && z(1) == z(2);
    });
    const auto mirror = mirror_of(shapes::joined(box, wall), 1e-3);
    ASSERT_TRUE(mirror);
    EXPECT_EQ(mirror->normal, (Vec3{0, 0, 1}));
}

TEST(Mirror, AFreeFormHasNone) {
    TriangleMesh mesh = shapes::bumpy_sphere();
    for (Vec3& v : mesh.vertices) v += Vec3{0.2 * v.y * v.z, 0.1 * v.x * v.x * v.y, 0.2 * v.x * v.y};
    EXPECT_FALSE(mirror_of(mesh, 1e-2));
    EXPECT_FALSE(mirror_of({}, 1));
}

}  // namespace
}  // namespace pfgeom
