// Surfaces of set trees: closed, with their creases and corners, and no wall or groove missing.
#include "cancel.h"
#include "fields.h"
#include "mesh_checks.h"
#include "pfgeom/base/error.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/polygonize/polygonize.h"
#include "trees.h"

namespace pfgeom::test {
namespace {

TriangleMesh mesh_of(const RegionPtr& region, double tolerance, int max_depth = 10) {
    return polygonize(tree_of(region), {.tolerance = tolerance, .min_depth = 3, .max_depth = max_depth});
}

/// Random points, half of them near the mesh: how many that are further than the tolerance from it are on
/// another side of it than of the tree.
int misjudged(const SetTree& tree, const TriangleMesh& mesh, double tolerance, std::uint64_t seed) {
    const Bvh bvh(mesh);
    Random random(seed);
    const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    int wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        Vec3 p{between(-1, 1), between(-1, 1), between(-1, 1)};
        if (i % 2 == 0 && !mesh.faces.empty()) {
            const Triangle& f = mesh.faces[random.below(mesh.faces.size())];
            p = p * (8 * tolerance) + (mesh.vertices[f[0]] + mesh.vertices[f[1]] + mesh.vertices[f[2]]) / 3;
        }
        const double signed_distance = mesh.faces.empty() ? -1 : bvh.signed_distance(p);
        if (std::abs(signed_distance) > tolerance && contains(tree, p) != (signed_distance > 0)) ++wrong;
    }
    return wrong;
}

double volume(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Triangle& f : mesh.faces)
        sum += dot(mesh.vertices[f[0]], cross(mesh.vertices[f[1]], mesh.vertices[f[2]])) / 6;
    return sum;
}

double nearest_vertex(const TriangleMesh& mesh, const Vec3& p) {
    double nearest = 1e30;
    for (const Vec3& v : mesh.vertices) nearest = std::min(nearest, norm(v - p));
    return nearest;
}

constexpr double kPi = 3.14159265358979323846;

RegionPtr unit_box() {
    return box({-0.5, -0.4, -0.3}, {0.6, 0.45, 0.31});
}

TEST(Tree, BoxIsTwelveTriangles) {
    const TriangleMesh mesh = mesh_of(unit_box(), 1e-3);
    ASSERT_TRUE(is_closed_manifold(mesh));
    EXPECT_EQ(mesh.faces.size(), 12U);
    EXPECT_NEAR(volume(mesh), 1.1 * 0.85 * 0.61, 1e-12);
    for (int i = 0; i < 8; ++i)
        EXPECT_LT(nearest_vertex(mesh, {i & 1 ? 0.6 : -0.5, i & 2 ? 0.45 : -0.4, i & 4 ? 0.31 : -0.3}),
                  1e-12);
}

// Planes at every angle to the grid, and on its points.
TEST(Tree, TurnedBoxes) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Random random(seed);
        const auto any = [&] { return 2 * random.uniform() - 1; };
        const Vec3 x = normalized({any(), any(), any()}), y = normalized(cross(x, {any(), any(), any()}));
        const Vec3 axes[3] = {x, y, cross(x, y)};
        RegionPtr region = leaf(true);
        double size = 8;
        for (const Vec3& n : axes) {
            const double half = 0.05 + 0.4 * random.uniform();
            region = both(both(region, where(half_space(n, half))), where(half_space(-n, half)));
            size *= half;
        }
        const TriangleMesh mesh = mesh_of(region, 1e-3);
        ASSERT_TRUE(is_closed_manifold(mesh)) << seed;
        EXPECT_NEAR(volume(mesh), size, 1e-9);
        EXPECT_LE(mesh.faces.size(), 32U) << seed;
    }
}

TEST(Tree, SphereTakesAsManyTrianglesAsAField) {
    const RegionPtr ball = where(turned({0.1, 0.02, -0.03}, 0.8));
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        const TriangleMesh mesh = mesh_of(ball, tolerance);
        ASSERT_TRUE(is_closed_manifold(mesh));
        const Fit fit = measure(sphere_field(0.8, {0.1, 0.02, -0.03}), mesh);
        EXPECT_LT(fit.max, 1.1 * tolerance);
        EXPECT_LT(fit.vertex_max, 0.05 * tolerance);
        EXPECT_EQ(fit.flipped, 0);
        EXPECT_LT(static_cast<double>(mesh.faces.size()), 3 * 4.837 * 0.8 / tolerance);
    }
}

/// A plate with three holes, one of them conical, and a boss with a groove.
RegionPtr bracket() {
    RegionPtr part = box({-0.8, -0.5, -0.1}, {0.8, 0.5, 0.1});
    part = either(part, both(where(turned({0.4, 0, 0}, 0.3, {0, 0, 1})),
                             both(where(half_space({0, 0, 1}, 0.4)), where(half_space({0, 0, -1}, 0)))));
    part = without(part, where(turned({-0.5, 0.2, 0}, 0.12, {0, 0, 1})));
    part = without(part, where(turned({-0.5, -0.2, 0}, 0.1, {0, 0, 1}, 0.5)));
    part = without(part, where(turned({0.4, 0, 0}, 0.2, {0, 0, 1})));
    return without(part, where(turned({0.4, 0, 0.4}, 0.05, {0, 1, 0})));
}

TEST(Tree, BracketAtSeveralTolerances) {
    const RegionPtr part = bracket();
    for (const double tolerance : {4e-3, 1e-3, 2.5e-4}) {
        const TriangleMesh mesh = mesh_of(part, tolerance);
        ASSERT_TRUE(is_closed_manifold(mesh));
        EXPECT_EQ(euler_characteristic(mesh), 2 - 2 * 3) << tolerance;
        EXPECT_EQ(misjudged(tree_of(part), mesh, tolerance, 1), 0) << tolerance;
        EXPECT_LT(static_cast<double>(mesh.faces.size()), 60 / std::sqrt(tolerance)) << tolerance;
        // Corners of the plate, and a point of the crease between the boss and its top.
        EXPECT_LT(nearest_vertex(mesh, {-0.8, 0.5, 0.1}), 1e-9);
        const Bvh bvh(mesh);
        for (const Vec3& p : {Vec3{0.1, 0, 0.4}, Vec3{0.7, 0, 0.1}, Vec3{-0.5, 0.32, -0.1}})
            EXPECT_LT(std::sqrt(bvh.closest(p).squared_distance), tolerance) << tolerance;
    }
}

// Two spheres meet in a circle; all of it must be an edge of the mesh.
TEST(Tree, CreaseOfTwoSpheres) {
    const RegionPtr pair = either(where(turned({-0.3, 0, 0}, 0.5)), where(turned({0.3, 0, 0}, 0.5)));
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        const TriangleMesh mesh = mesh_of(pair, tolerance);
        ASSERT_TRUE(is_closed_manifold(mesh));
        EXPECT_EQ(misjudged(tree_of(pair), mesh, tolerance, 2), 0);
        int crease = 0;
        for (const Vec3& v : mesh.vertices) crease += std::abs(v.x) < 1e-3 * tolerance;
        EXPECT_GT(crease, 1.5 / std::sqrt(tolerance)) << tolerance;
    }
}

// Where three balls meet at so small an angle that their common point is far from what is near all three.
TEST(Tree, TipsOfNarrowPits) {
    constexpr double kRadius = 0.4, kTolerance = 1e-3;
    for (const double height : {0.05, 0.02, 0.01}) {
        const double off = std::sqrt(kRadius * kRadius - height * height);
        RegionPtr balls = leaf(false);
        for (const Vec3& way :
             {Vec3{1, 0, 0}, Vec3{-0.5, std::sqrt(0.75), 0}, Vec3{-0.5, -std::sqrt(0.75), 0}})
            balls = either(balls, where(turned(way * off, kRadius)));
        const TriangleMesh mesh = mesh_of(balls, kTolerance);
        ASSERT_TRUE(is_closed_manifold(mesh));
        for (const double z : {height, -height})
            EXPECT_LT(nearest_vertex(mesh, {0, 0, z}), 0.1 * kTolerance) << height;
    }
}

TEST(Tree, BitsBesideTheShapeAreLeftOut) {
    const auto pieces = [](double radius) {
        const RegionPtr both = either(where(turned({-0.3, 0, 0}, 0.5)), where(turned({0.8, 0, 0}, radius)));
        const TriangleMesh mesh = mesh_of(both, 1e-2);
        EXPECT_TRUE(is_closed_manifold(mesh));
        return euler_characteristic(mesh) / 2;
    };
    EXPECT_EQ(pieces(0.009), 1) << "volume over area: a third of the radius";
    EXPECT_EQ(pieces(0.08), 2);
}

// A quarter round that runs tangentially into both of its planes.
TEST(Tree, TangentFillet) {
    const Vec3 axis{0, 0, 1};
    const RegionPtr corner = both(where(half_space({1, 0, 0}, 0.5)), where(half_space({0, 1, 0}, 0.5)));
    const RegionPtr beyond = both(where(half_space({-1, 0, 0}, -0.3)), where(half_space({0, -1, 0}, -0.3)));
    const RegionPtr filleted = with_leaves(beyond, where(turned({0.3, 0.3, 0}, 0.2, axis)), corner);
    const RegionPtr part = both(filleted, box({-0.5, -0.5, -0.5}, {0.7, 0.7, 0.5}));
    const TriangleMesh mesh = mesh_of(part, 1e-3);
    ASSERT_TRUE(is_closed_manifold(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_EQ(misjudged(tree_of(part), mesh, 1e-3, 3), 0);
    EXPECT_LT(mesh.faces.size(), 120U);
}

// Walls and grooves from a fifth of the tolerance up, flat and bent: in or out by less than the tolerance
// does not show, but they have to be there.
TEST(Tree, ThinWalls) {
    const double tolerance = 1e-3;
    for (const double width : {2e-4, 1e-3, 5e-3}) {
        const Vec3 n = normalized({1, 0.3, 0.2});
        const RegionPtr flat = both(both(where(half_space(n, width / 2)), where(half_space(-n, width / 2))),
                                    where(turned({}, 0.7)));
        const RegionPtr pipe =
            without(where(turned({}, 0.4, {0, 0, 1})), where(turned({}, 0.4 - width, {0, 0, 1})));
        const RegionPtr tube =
            both(pipe, both(where(half_space({0, 0, 1}, 0.6)), where(half_space({0, 0, -1}, 0.6))));
        for (const RegionPtr& wall : {flat, tube}) {
            const TriangleMesh mesh = mesh_of(wall, tolerance);
            ASSERT_TRUE(is_closed_manifold(mesh));
            if (width >= tolerance) {
                EXPECT_EQ(euler_characteristic(mesh), wall == flat ? 2 : 0);
            }
            EXPECT_EQ(misjudged(tree_of(wall), mesh, tolerance, 4), 0);
            const double whole =
                wall == flat ? kPi * 0.49 * width : 2 * kPi * (0.4 - width / 2) * width * 1.2;
            EXPECT_NEAR(volume(mesh), whole, 0.2 * whole) << width;
        }
    }
}

// Bodies that touch along an edge and at a corner: cut apart, so that the mesh stays a manifold.
TEST(Tree, TouchingBoxes) {
    const RegionPtr x = where(half_space({1, 0, 0}, 0.1)), y = where(half_space({0, 1, 0}, 0.2)),
                    z = where(half_space({0, 0, 1}, 0.3));
    const auto differ = [](const RegionPtr& a, const RegionPtr& b) {
        return with_leaves(a, with_leaves(b, leaf(false), leaf(true)), b);
    };
    for (const RegionPtr& checkers : {differ(x, y), differ(differ(x, y), z)}) {
        const RegionPtr part = both(box({-0.5, -0.5, -0.5}, {0.6, 0.6, 0.6}), checkers);
        const TriangleMesh mesh = mesh_of(part, 1e-3);
        ASSERT_TRUE(is_closed_manifold(mesh));
        EXPECT_EQ(misjudged(tree_of(part), mesh, 1e-3, 5), 0);
    }
}

/// Faces without area, with the coordinates as they are or in single precision.
int without_area(const TriangleMesh& mesh) {
    int count = 0;
    const auto single = [](const Vec3& v) {
        return Vec3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    for (const Triangle& f : mesh.faces) {
        const Vec3 &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
        count +=
            cross(b - a, c - a) == Vec3{} || cross(single(b) - single(a), single(c) - single(a)) == Vec3{};
    }
    return count;
}

// Without turning slivers back 169 of its edges are folds, with it 121, some of which are of the shape.
TEST(Tree, RandomTreesAreManifoldsAndRight) {
    std::size_t faces = 0;
    int wrong = 0, folded = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const SetTree tree = tree_of(random_region(random, 1 + static_cast<int>(seed % 5)));
        const double tolerance = 0.01;
        const TriangleMesh mesh = polygonize(tree, {.tolerance = tolerance, .min_depth = 2, .max_depth = 6});
        ASSERT_TRUE(is_closed_manifold(mesh)) << seed;
        faces += mesh.faces.size();
        wrong += misjudged(tree, mesh, 2 * tolerance, seed);
        folded += edges_that_turn(mesh, 154).count;
        EXPECT_EQ(without_area(mesh), 0) << seed;
    }
    EXPECT_LT(folded, 140);
    EXPECT_GT(faces, 10'000U);
    EXPECT_EQ(wrong, 0);
}

// Numbers that no encoder would write, but a file may hold.
TEST(Tree, WildCoefficients) {
    for (const double big : {0.0, 1e-300, 1e18, 1e200, std::numeric_limits<double>::infinity()})
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            Random random(seed);
            SetTree tree = tree_of(random_region(random, 4));
            for (TreeQuadric& q : tree.quadrics) q.quadric.c[random.below(10)] *= big;
            const TriangleMesh mesh = polygonize(tree, {.tolerance = 0.05, .min_depth = 1, .max_depth = 3});
            EXPECT_TRUE(is_closed_manifold(mesh)) << big << " " << seed;
        }
}

TEST(Tree, EmptyAndFull) {
    EXPECT_TRUE(mesh_of(leaf(false), 1e-2).faces.empty());
    const TriangleMesh cube = mesh_of(leaf(true), 1e-2);
    EXPECT_TRUE(is_closed_manifold(cube));
    EXPECT_NEAR(volume(cube), 8, 1e-12);
    EXPECT_EQ(cube.faces.size(), 12U);
}

TEST(Tree, SameMeshForAnyNumberOfThreads) {
    Task one, five;
    one.threads = 1;
    five.threads = 5;
    const SetTree tree = tree_of(bracket());
    const TriangleMesh a = polygonize(tree, {.tolerance = 1e-3}, one),
                       b = polygonize(tree, {.tolerance = 1e-3}, five);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.faces, b.faces);
}

TEST(Tree, Budgets) {
    const SetTree tree = tree_of(bracket());
    EXPECT_THROW(polygonize(tree, {.tolerance = 1e-4, .max_cells = 5000}), LimitExceeded);
    EXPECT_THROW(polygonize(tree, {.tolerance = 1e-4, .max_faces = 500}), LimitExceeded);
    EXPECT_THROW(polygonize(tree, {.tolerance = -1}), InvalidInput);
}

TEST(Tree, CancelsSoon) {
    const SetTree tree = tree_of(bracket());
    for (const int milliseconds : {0, 50, 400, 1500}) {
        expect_cancels_soon(milliseconds, [&](const Task& task) {
            polygonize(tree, {.tolerance = 1e-7, .max_depth = 14}, task);
        });
    }
}

}  // namespace
}  // namespace pfgeom::test
