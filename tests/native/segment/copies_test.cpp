#include "pfgeom/segment/copies.h"

#include "pfgeom/base/error.h"
#include "pfgeom/mesh/bvh.h"
#include "placed_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

using shapes::placed;
using shapes::random_place;
using shapes::warped;

bool mirrors(const Similarity& s) {
    return dot(s.rows[0], cross(s.rows[1], s.rows[2])) < 0;
}

// The groups, each copy's place compared with where it is.
std::vector<CopyGroup> checked_groups(const TriangleMesh& scene, double tolerance) {
    const PreparedMesh prepared = prepare_mesh(scene, 0);
    const std::vector<CopyGroup> groups = find_copies(prepared, tolerance, {});
    for (const CopyGroup& group : groups) {
        const TriangleMesh first = extract_island(prepared, prepared.islands[group[0].island]);
        EXPECT_EQ(group[0].place, Similarity{}) << "the first is in place";
        for (const Copy& copy : group) {
            const Bvh bvh(extract_island(prepared, prepared.islands[copy.island]));
            for (const Vec3& v : first.vertices)
                EXPECT_LE(std::sqrt(bvh.closest(copy.place.apply(v)).squared_distance), tolerance);
        }
    }
    return groups;
}

TriangleMesh torus_without_symmetry() {
    return warped(shapes::torus(1, 0.4, 24, 12));
}

TEST(Copies, MovedTurnedMirroredAndGrown) {
    Random random(1);
    const TriangleMesh part = torus_without_symmetry();
    TriangleMesh scene = part;
    append(placed(part, random_place(random, 20)), scene);
    append(placed(part, random_place(random, 20, true)), scene);
    append(placed(part, random_place(random, 20, false, 0.5)), scene);
    append(placed(part, random_place(random, 20, true, 0.8)), scene);
    const auto groups = checked_groups(scene, 1e-9);
    ASSERT_EQ(groups.size(), 1U);
    ASSERT_EQ(groups[0].size(), 5U);
    // The pattern is one of the first three, and whether that is a mirrored one is up to rounding.
    const bool turned = groups[0][0].island == 2;
    for (const Copy& copy : groups[0]) {
        EXPECT_EQ(mirrors(copy.place), (copy.island == 2 || copy.island == 4) != turned) << copy.island;
        const double scale = copy.island == 3 ? 0.5 : copy.island == 4 ? 0.8 : 1;
        EXPECT_NEAR(copy.place.scale, scale, 1e-9);
    }
}

TEST(Copies, OrderOfVerticesDoesNotMatter) {
    Random random(2);
    const TriangleMesh part = torus_without_symmetry();
    TriangleMesh scene = part;
    for (std::uint64_t i = 0; i < 4; ++i)
        append(placed(shapes::shuffled(part, i), random_place(random, 20, i % 2 == 0)), scene);
    const auto groups = checked_groups(scene, 1e-9);
    ASSERT_EQ(groups.size(), 1U);
    EXPECT_EQ(groups[0].size(), 5U);
}

// Whose axes of inertia say nothing, or not all. No mirror is needed.
TEST(Copies, SymmetricShapes) {
    for (const TriangleMesh& part :
         {shapes::cube(), shapes::sphere(2), shapes::cylinder(6), shapes::cylinder(32)}) {
        Random random(3);
        TriangleMesh scene = placed(part, random_place(random, 30));
        for (std::uint64_t i = 0; i < 4; ++i)
            append(placed(shapes::shuffled(part, i), random_place(random, 30, i % 2 == 0)), scene);
        const auto groups = checked_groups(scene, 1e-8);
        ASSERT_EQ(groups.size(), 1U);
        ASSERT_EQ(groups[0].size(), 5U);
        for (const Copy& copy : groups[0])
            EXPECT_FALSE(mirrors(copy.place)) << part.vertices.size() << " vertices";
    }
}

TEST(Copies, TheTessellationDoesNotMatter) {
    Random random(4);
    for (const TriangleMesh& part : {shapes::cube(), shapes::cylinder(6), shapes::cylinder(24)}) {
        TriangleMesh scene = placed(part, random_place(random, 30));
        append(placed(shapes::divided(part), random_place(random, 30)), scene);
        append(placed(shapes::divided(shapes::divided(part)), random_place(random, 30)), scene);
        const auto groups = checked_groups(scene, 1e-3);
        ASSERT_EQ(groups.size(), 1U);
        EXPECT_EQ(groups[0].size(), 3U);
    }
}

TEST(Copies, OfTheToleranceOnly) {
    Random random(5);
    const TriangleMesh part = torus_without_symmetry();
    TriangleMesh scene = part;
    append(placed(shapes::scaled(part, {1, 1, 1.01}), random_place(random, 20)), scene);
    EXPECT_EQ(checked_groups(scene, 1e-3).size(), 0U);
    EXPECT_EQ(checked_groups(scene, 2e-2).size(), 1U);
}

TEST(Copies, InsideOutIsAnotherShape) {
    TriangleMesh scene = torus_without_symmetry();
    append(shapes::translated(shapes::flipped(scene), {9, 0, 0}), scene);
    EXPECT_EQ(checked_groups(scene, 1e-3).size(), 0U);
}

TEST(Copies, CavitiesAreLeftOut) {
    TriangleMesh hollow = shapes::sphere(3);
    append(shapes::flipped(shapes::sphere(2, 0.5)), hollow);
    TriangleMesh scene = hollow;
    append(shapes::translated(hollow, {5, 0, 0}), scene);
    const auto groups = checked_groups(scene, 1e-6);
    ASSERT_EQ(groups.size(), 1U);
    EXPECT_EQ(groups[0].size(), 2U);
    EXPECT_EQ(groups[0][0].island, 0U);
    EXPECT_EQ(groups[0][1].island, 2U);
}

TEST(Copies, CanBeCancelled) {
    CancelToken token;
    token.cancel();
    Task task;
    task.cancel = &token;
    EXPECT_THROW(find_copies(prepare_mesh(shapes::scene_of_islands(24), 0), 1e-3, task), Cancelled);
}

}  // namespace
}  // namespace pfgeom
