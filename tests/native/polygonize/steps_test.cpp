// Steps between surfaces of a tree that do not quite meet, and folds.
#include "fit/sampled_distance.h"
#include "mesh_checks.h"
#include "pfgeom/polygonize/labelled_mesh.h"
#include "pfgeom/polygonize/polygonize.h"
#include "pfgeom/polygonize/unfold.h"
#include "trees.h"

namespace pfgeom::test {
namespace {

constexpr double kTolerance = 1e-3;

TriangleMesh mesh_of(const SetTree& tree, double highest_step) {
    return polygonize(
        tree, {.tolerance = kTolerance, .min_depth = 3, .max_depth = 10, .highest_step = highest_step});
}

/// Another top on either side of the plane x = 0, which lean by so much towards each other.
SetTree box_with_step(double height, double lean = 0) {
    const auto top = [&](double z, double slope) { return where(half_space(normalized({slope, 0, 1}), z)); };
    const RegionPtr sides = box({-0.5, -0.4, -0.3}, {0.6, 0.45, 0.5});
    return tree_of(ask(half_space({1, 0, 0}, 0.013), both(sides, top(0.3, lean)),
                       both(sides, top(0.3 - height, -lean))));
}

TEST(Steps, OfABoxAreClosed) {
    for (const double height : {0.002, 0.01, 0.019}) {
        const SetTree tree = box_with_step(height);
        const TriangleMesh with = mesh_of(tree, 0), without = mesh_of(tree, 0.02);
        ASSERT_TRUE(is_closed_manifold(without));
        EXPECT_LT(without.faces.size(), with.faces.size());
        const double less = edges_that_turn(with, 20).length - edges_that_turn(without, 20).length;
        EXPECT_NEAR(less, 2 * 0.85, 2.5 * height) << height;  // both sides of the wall, and its height
        EXPECT_LE(two_sided(with, without), height) << height;
    }
}

TEST(Steps, ThatAreHigherStay) {
    const SetTree tree = box_with_step(0.03);
    const TriangleMesh with = mesh_of(tree, 0), without = mesh_of(tree, 0.02);
    EXPECT_EQ(with.vertices, without.vertices);
    EXPECT_EQ(with.faces, without.faces);
}

// The faces at a rim or at an edge do not face the same way, and a dihedral of 40 degrees is a crease.
TEST(Steps, CreasesAreNone) {
    for (const RegionPtr& region :
         {box({-0.5, -0.4, -0.3}, {0.6, 0.45, 0.31}), box({-0.5, -0.4, 0.011}, {0.6, 0.45, 0.021})}) {
        const TriangleMesh mesh = mesh_of(tree_of(region), 0.05);
        EXPECT_TRUE(is_closed_manifold(mesh));
        EXPECT_EQ(mesh.faces.size(), 12U);
        EXPECT_EQ(edges_that_turn(mesh, 30).count, 12);
    }
    const SetTree roof = box_with_step(0.01, 0.36);
    EXPECT_EQ(mesh_of(roof, 0).faces, mesh_of(roof, 0.02).faces);
}

// Halves of balls that differ, apart at a plane askew. Where triangles are as small as the step is high it
// stays.
TEST(Steps, OfBallsAreClosed) {
    const Quadric apart = half_space(normalized({0.8, 0.3, 0.52}), 0.05);
    for (const Quadric& other : {turned({}, 0.604), turned({0.002, -0.001, 0.001}, 0.597)}) {
        const SetTree tree = tree_of(ask(apart, where(turned({}, 0.6)), where(other)));
        const TriangleMesh with = mesh_of(tree, 0), without = mesh_of(tree, 0.0085);
        ASSERT_TRUE(is_closed_manifold(without));
        EXPECT_EQ(euler_characteristic(without), 2);
        EXPECT_LT(edges_that_turn(without, 30).length, 0.35 * edges_that_turn(with, 30).length);
        EXPECT_LE(two_sided(with, without), 0.005);
    }
}

TEST(Steps, RandomTreesStayManifoldsOfTheirGenus) {
    int closed = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const SetTree tree = tree_of(random_region(random, 1 + static_cast<int>(seed % 5)));
        PolygonizeOptions options{.tolerance = 0.01, .min_depth = 2, .max_depth = 6};
        const TriangleMesh with = polygonize(tree, options);
        options.highest_step = 0.05;
        const TriangleMesh without = polygonize(tree, options);
        ASSERT_TRUE(is_closed_manifold(without)) << seed;
        EXPECT_EQ(euler_characteristic(without), euler_characteristic(with)) << seed;
        closed += with.faces != without.faces;
    }
    EXPECT_GT(closed, 20);
}

TEST(Steps, SameMeshForAnyNumberOfThreads) {
    Task one, five;
    one.threads = 1;
    five.threads = 5;
    const PolygonizeOptions options{.tolerance = kTolerance, .highest_step = 0.02};
    const TriangleMesh a = polygonize(box_with_step(0.01), options, one),
                       b = polygonize(box_with_step(0.01), options, five);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.faces, b.faces);
}

/// A box with a top of n by n squares.
LabelledMesh fine_box(std::int32_t n) {
    LabelledMesh mesh;
    std::vector<Triangle> faces;
    const auto at = [&](std::int32_t x, std::int32_t y) { return (n + 1) * y + x; };
    for (std::int32_t y = 0; y <= n; ++y)
        for (std::int32_t x = 0; x <= n; ++x)
            mesh.mesh.position.push_back({static_cast<double>(x), static_cast<double>(y), 0});
    for (std::int32_t y = 0; y < n; ++y)
        for (std::int32_t x = 0; x < n; ++x) {
            faces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            faces.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    const auto tip = static_cast<std::int32_t>(mesh.mesh.position.size());
    mesh.mesh.position.push_back({n / 2.0, n / 2.0, -1.0 * n});
    for (std::int32_t i = 0; i < n; ++i) {
        faces.push_back({at(i + 1, 0), at(i, 0), tip});
        faces.push_back({at(n, i + 1), at(n, i), tip});
        faces.push_back({at(i, n), at(i + 1, n), tip});
        faces.push_back({at(0, i), at(0, i + 1), tip});
    }
    mesh.mesh.normal.resize(mesh.mesh.position.size());
    mesh.label.assign(faces.size(), 0);
    mesh.mesh.set_faces(std::move(faces));
    return mesh;
}

TriangleMesh triangles(const LabelledMesh& mesh) {
    return {mesh.mesh.position, mesh.mesh.faces()};
}

TEST(Unfold, TakesFoldsAwayAndNothingElse) {
    LabelledMesh mesh = fine_box(8);
    const TriangleMesh flat = triangles(mesh);
    unfold(2, mesh, {});
    EXPECT_EQ(mesh.mesh.faces(), flat.faces);
    mesh.mesh.position[9 * 4 + 4] = {5.4, 4.3, 0.02};  // over its neighbour
    ASSERT_TRUE(is_closed_manifold(triangles(mesh)));
    ASSERT_GT(edges_that_turn(triangles(mesh), 154).count, 0);
    LabelledMesh kept = mesh;
    unfold(0.1, kept, {});
    EXPECT_EQ(kept.mesh.faces(), mesh.mesh.faces());  // its edges are longer
    unfold(2, mesh, {});
    EXPECT_TRUE(is_closed_manifold(triangles(mesh)));
    EXPECT_EQ(edges_that_turn(triangles(mesh), 154).count, 0);
    EXPECT_GE(mesh.mesh.faces().size() + 4, flat.faces.size());
    EXPECT_EQ(mesh.label.size(), mesh.mesh.faces().size());
}

}  // namespace
}  // namespace pfgeom::test
