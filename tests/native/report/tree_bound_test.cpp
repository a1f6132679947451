#include "pfgeom/report/tree_bound.h"

#include "pfgeom/base/random.h"
#include "pfgeom/mesh/sample.h"
#include "pfgeom/report/tree_bound_ball.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace pfgeom {
namespace {

constexpr double kTolerance = 2e-3;

// ---- Trees, from their parts ----

using Part = std::function<std::int32_t(SetTree&)>;  // adds its nodes; returns the first

std::int32_t add_node(SetTree& tree, const TreeNode& node, const Part& high, const Part& low) {
    const std::size_t row = tree.nodes.size();
    tree.nodes.push_back(node);
    const std::int32_t first = high(tree), second = low(tree);
    tree.nodes[row].high = first;
    tree.nodes[row].low = second;
    return static_cast<std::int32_t>(row);
}

Part leaf(bool inside) {
    return [=](SetTree& tree) {
        tree.nodes.push_back({.kind = inside ? TreeNode::Kind::inside : TreeNode::Kind::outside});
        return static_cast<std::int32_t>(tree.nodes.size()) - 1;
    };
}

const Part kInside = leaf(true), kOutside = leaf(false);

Part cut(int axis, double at, const Part& high, const Part& low) {
    return [=](SetTree& tree) {
        TreeNode node{.kind = TreeNode::Kind::cut, .axis = static_cast<std::uint8_t>(axis)};
        node.cut = at;
        return add_node(tree, node, high, low);
    };
}

Part ask(const Quadric& quadric, const Part& high, const Part& low) {
    return [=](SetTree& tree) {
        tree.quadrics.push_back({.quadric = quadric});
        const auto row = static_cast<std::int32_t>(tree.quadrics.size()) - 1;
        return add_node(tree, {.kind = TreeNode::Kind::ask, .quadric = row}, high, low);
    };
}

// Within the box lo .. hi one part, around it the other.
Part window(const Box& box, const Part& within, const Part& around) {
    Part part = within;
    for (int axis = 0; axis < 3; ++axis)
        part = cut(axis, box.lo[axis], cut(axis, box.hi[axis], around, part), around);
    return part;
}

SetTree tree_of(const Part& root, double half = 1) {
    SetTree tree;
    const auto side = static_cast<std::int32_t>(half * 2048);  // in units of 2^-11
    tree.low = {-side, -side, -side}, tree.high = {side, side, side};
    root(tree);
    return tree;
}

Box cube_around(const Vec3& centre, double half) {
    return {centre - Vec3{half, half, half}, centre + Vec3{half, half, half}};
}

// ---- Quadrics: positive inside ----

Quadric ball(const Vec3& c, double r) {
    return {{-1, -1, -1, 0, 0, 0, 2 * c.x, 2 * c.y, 2 * c.z, r * r - squared_norm(c)}};
}

Quadric half_space(const Vec3& normal, const Vec3& through) {
    return {{0, 0, 0, 0, 0, 0, normal.x, normal.y, normal.z, -dot(normal, through)}};
}

// Along z.
Quadric cylinder(double x, double y, double r) {
    return {{-1, -1, 0, 0, 0, 0, 2 * x, 2 * y, 0, r * r - x * x - y * y}};
}

// ---- Meshes ----

// Vertices (r, z) turned around the z axis; the first and the last point lie on it.
TriangleMesh revolved(const std::vector<std::array<double, 2>>& profile, int sides) {
    TriangleMesh mesh;
    const int rows = static_cast<int>(profile.size()) - 2;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < sides; ++j) {
            const auto [c, s] = shapes::on_circle(static_cast<double>(j) / sides);
            const auto& [r, z] = profile[static_cast<std::size_t>(i) + 1];
            mesh.vertices.push_back({r * c, r * s, z});
        }
    mesh.faces = shapes::grid_faces(rows, sides, false, true);
    mesh.vertices.push_back({0, 0, profile.front()[1]});
    mesh.vertices.push_back({0, 0, profile.back()[1]});
    for (int j = 0; j < sides; ++j) {
        const int next = (j + 1) % sides, last = (rows - 1) * sides;
        mesh.faces.push_back({rows * sides, j, next});
        mesh.faces.push_back({rows * sides + 1, last + next, last + j});
    }
    return mesh;
}

// The surface of the union of two balls of radius 1/2 around (0, 0, ±0.3); they meet in a circle of radius
// 0.4.
TriangleMesh two_balls_mesh(int rows = 32, int sides = 96) {
    std::vector<std::array<double, 2>> profile;
    for (int i = 0; i <= rows; ++i) {
        const auto [c, s] = shapes::on_circle(i / (3.0 * rows));
        profile.push_back({0.5 * s, 0.3 + 0.5 * c});
    }
    for (int i = rows - 1; i >= 0; --i) {
        const std::size_t mirrored = static_cast<std::size_t>(i);
        profile.push_back({profile[mirrored][0], -profile[mirrored][1]});
    }
    return revolved(profile, sides);
}

Part two_balls(double z, double r) {
    return ask(ball({0, 0, z}, r), kInside, ask(ball({0, 0, -z}, r), kInside, kOutside));
}

TreeBound bound(const SetTree& tree, const TriangleMesh& mesh, double tolerance = kTolerance,
                const TreeBoundOptions& options = {}, const Task& task = {}) {
    return bound_tree(tree, mesh, Bvh(mesh), tolerance, options, task);
}

// By winding numbers, which the certificate does not use.
void expect_true_labels(const std::vector<LabelledPoint>& points, const Bvh& bvh) {
    for (const LabelledPoint& p : points) {
        const double distance = bvh.signed_distance(p.point);
        ASSERT_EQ(p.inside, distance > 0);
        ASSERT_NEAR(p.distance, std::abs(distance), 1e-12);
    }
}

void expect_refuted(const SetTree& tree, const TriangleMesh& mesh, double tolerance = kTolerance) {
    const Bvh bvh(mesh);
    const TreeBound found = bound_tree(tree, mesh, bvh, tolerance, {}, {});
    EXPECT_FALSE(found.certified);
    EXPECT_FALSE(found.counter_examples.empty());
    expect_true_labels(found.counter_examples, bvh);
    for (const LabelledPoint& p : found.counter_examples) {
        ASSERT_GT(p.distance, tolerance * (1 - 1e-8));
        ASSERT_NE(contains(tree, p.point), p.inside);
    }
}

// ---- Honest models ----

TEST(TreeBound, CubeIsItsBox) {
    const TreeBound found = bound(tree_of(kInside, 0.5), shapes::cube(0.5));
    EXPECT_TRUE(found.certified);
    EXPECT_EQ(found.proved, kTolerance);
    EXPECT_EQ(found.counts.missed, 0);
}

TEST(TreeBound, Ball) {
    const TriangleMesh mesh = shapes::sphere(4, 0.4);
    const TreeBound found = bound(tree_of(ask(ball({}, 0.4), kInside, kOutside)), mesh);
    EXPECT_TRUE(found.holds(kTolerance));
    EXPECT_FALSE(found.labels.empty());
    expect_true_labels(found.labels, Bvh(mesh));
}

TEST(TreeBound, TwoOverlappingBalls) {
    EXPECT_TRUE(bound(tree_of(two_balls(0.3, 0.5)), two_balls_mesh()).holds(kTolerance));
}

TEST(TreeBound, NormalsThatPointInwards) {
    const SetTree tree = tree_of(ask(ball({}, 0.4), kInside, kOutside));
    EXPECT_TRUE(bound(tree, shapes::flipped(shapes::sphere(4, 0.4))).holds(kTolerance));
}

TEST(TreeBound, ShellWithACavity) {
    const TriangleMesh mesh =
        shapes::joined(shapes::sphere(4, 0.4), shapes::flipped(shapes::sphere(4, 0.3, {0.05, 0, 0})));
    const Part hollow = ask(ball({0.05, 0, 0}, 0.3), kOutside, kInside);
    EXPECT_TRUE(bound(tree_of(ask(ball({}, 0.4), hollow, kOutside)), mesh).holds(kTolerance));
    expect_refuted(tree_of(ask(ball({}, 0.4), kInside, kOutside)), mesh);
}

// The model's deviation is known; what is certified must be true, and what is true by a margin is certified.
TEST(TreeBound, SaysWhatIsTrueOfBalls) {
    const TriangleMesh mesh = shapes::sphere(4, 0.4);
    const Bvh bvh(mesh);
    const double sagitta = 0.4 - bvh.signed_distance({});
    ASSERT_LT(sagitta, 0.8 * kTolerance);
    for (const double shift : {-1.5, -1.02, -0.99, -0.5, 0.2, 0.5, 1.01, 3.0}) {
        const double grown = shift * kTolerance;
        const double deviation = std::max(std::abs(grown), std::abs(grown + sagitta));
        const TreeBound found =
            bound_tree(tree_of(ask(ball({}, 0.4 + grown), kInside, kOutside)), mesh, bvh, kTolerance, {}, {});
        if (found.certified) {
            EXPECT_LE(deviation, found.proved * (1 + 1e-9)) << shift;
        }
        if (deviation < 0.98 * kTolerance) {
            EXPECT_TRUE(found.holds(kTolerance)) << shift;
        }
        EXPECT_EQ(found.counter_examples.empty(), deviation < kTolerance * (1 + 1e-9)) << shift;
    }
}

// ---- Models that are wrong ----

TEST(TreeBound, ShiftedQuadricsGiveCounterExamples) {
    expect_refuted(tree_of(two_balls(0.3, 0.5 + 2 * kTolerance)), two_balls_mesh());
    expect_refuted(tree_of(two_balls(0.3 - 2 * kTolerance, 0.5)), two_balls_mesh());
    expect_refuted(tree_of(ask(ball({0, 0, 0.3}, 0.5), kInside, kOutside)), two_balls_mesh());
}

TEST(TreeBound, BoxThatClipsTheMesh) {
    for (const double off : {1.1, 2.0, 40.0}) {
        expect_refuted(tree_of(kInside, 0.5), shapes::cube(0.5 + off * kTolerance));
        expect_refuted(tree_of(kInside, 0.5), shapes::cube(0.5 - off * kTolerance));
    }
}

TEST(TreeBound, NothingAndEverything) {
    expect_refuted(tree_of(kOutside), shapes::cube(0.5));
    expect_refuted(tree_of(kInside), shapes::cube(0.5));
}

// A chamfer: no point is on the wrong side by more than 0.71 of its depth, but the mesh's edge is as far from
// the model as the chamfer is deep.
TEST(TreeBound, RetreatingCreaseIsSeenFromTheMesh) {
    const double depth = 1.2 * kTolerance, r = std::sqrt(0.5);
    const Quadric chamfer = half_space({-r, -r, 0}, Vec3{0.5, 0.5, 0} - Vec3{r, r, 0} * depth);
    const SetTree tree = tree_of(ask(chamfer, kInside, kOutside), 0.5);
    const TriangleMesh mesh = shapes::cube(0.5);
    TreeBoundOptions one_way;
    one_way.mesh_to_model = false;
    EXPECT_TRUE(bound(tree, mesh, kTolerance, one_way).holds(kTolerance));

    const TreeBound found = bound(tree, mesh);
    EXPECT_FALSE(found.holds(1.19 * kTolerance));
    EXPECT_TRUE(found.holds(1.3 * kTolerance));
    ASSERT_FALSE(found.missed.empty());
    for (const LabelledPoint& p : found.missed) {
        EXPECT_TRUE(p.inside);
        EXPECT_FALSE(contains(tree, p.point));
    }
    EXPECT_TRUE(bound(tree, mesh, 1.25 * kTolerance).holds(1.25 * kTolerance));
}

TEST(TreeBound, MissingHoleIsSeenFromTheMesh) {
    const TriangleMesh mesh =  // a cavity that is all within the tolerance of its walls
        shapes::joined(shapes::cube(0.5), shapes::flipped(shapes::cube(0.9 * kTolerance)));
    EXPECT_TRUE(bound(tree_of(kInside, 0.5), mesh).counter_examples.empty());
    EXPECT_FALSE(bound(tree_of(kInside, 0.5), mesh).certified);
}

// ---- Specks ----

Vec3 random_direction(Random& random) {
    for (;;) {
        const double x = random.uniform(), y = random.uniform(), z = random.uniform();
        const Vec3 d = 2 * Vec3{x, y, z} - Vec3{1, 1, 1};
        if (squared_norm(d) < 1 && squared_norm(d) > 0.01) return normalized(d);
    }
}

// What of the label `inside` there is between two planes through a point with normals 1/1000 apart, or
// between two cylinders tangent from within; in a small window, elsewhere the other label.
Part speck(Random& random, bool inside, bool wedge, const Vec3& centre) {
    const Part wrong = leaf(inside), right = leaf(!inside);
    const Box box = cube_around(centre, 0.02);
    if (wedge) {
        const Vec3 n = random_direction(random);
        const Vec3 tilted = normalized(n + 1e-3 * normalized(cross(n, random_direction(random))));
        return window(box, ask(half_space(n, centre), ask(half_space(tilted, centre), right, wrong), right),
                      right);
    }
    const double r = 0.05 + 0.1 * random.uniform(), thin = 2e-5 * (1 + random.uniform());
    const Quadric outer = cylinder(centre.x - r, centre.y, r),
                  inner = cylinder(centre.x - r - thin, centre.y, r - thin);
    return window(box, ask(outer, ask(inner, right, wrong), right), right);
}

SetTree cube_with_speck(std::uint64_t seed) {
    Random random(seed);
    const bool inside = seed % 2 == 0, wedge = seed % 4 < 2;
    const double y = 0.4 * random.uniform(), z = -0.4 * random.uniform();
    const Vec3 centre{inside ? 0.7 : 0.3, y, z};
    const Part planted = speck(random, inside, wedge, centre);
    const Part here = window(cube_around({}, 0.5), inside ? kInside : planted, inside ? planted : kOutside);
    return tree_of(here);
}

TEST(TreeBound, FindsPlantedSpecks) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        expect_refuted(cube_with_speck(seed), shapes::cube(0.5));
    }
}

// The same questions, with a gap where the specks are: nothing is wrong, which paired pruning must see.
TEST(TreeBound, NearlyEqualQuadricsWithoutASpeck) {
    Random random(5);
    for (int i = 0; i < 10; ++i) {
        const Vec3 n = random_direction(random), tilted = normalized(n + 1e-3 * random_direction(random));
        const Vec3 centre{0.3, 0, 0};
        const Part between = ask(half_space(tilted, centre - n * 1e-4), kInside, kOutside);
        const Part planted =
            window(cube_around(centre, 0.02), ask(half_space(n, centre), between, kInside), kInside);
        const TreeBound found =
            bound(tree_of(window(cube_around({}, 0.5), planted, kOutside)), shapes::cube(0.5));
        EXPECT_TRUE(found.holds(kTolerance)) << i;
    }
}

// ---- A slower checker: points around the surface, sides by winding numbers ----

bool samples_refute(const SetTree& tree, const TriangleMesh& mesh, const Bvh& bvh, double tolerance) {
    Random random(3);
    for (const Vec3& at : sample_surface(mesh, 1500, 11).points)
        for (const double reach : {1.01, 1.1, 1.5, 2.5, 6.0}) {
            const Vec3 p = at + random_direction(random) * (reach * tolerance);
            const double distance = bvh.signed_distance(p);
            if (std::abs(distance) > tolerance && contains(tree, p) != (distance > 0)) return true;
        }
    return false;
}

TEST(TreeBound, AgreesWithDenseSamples) {
    const TriangleMesh mesh = two_balls_mesh(24, 64);
    const Bvh bvh(mesh);
    const double tolerance = 4e-3;
    Random random(17);
    int refuted = 0;
    for (int i = 0; i < 18; ++i) {
        const double z = 0.3 + 0.01 * (random.uniform() - 0.5), r = 0.5 + 0.01 * (random.uniform() - 0.5);
        Part root = two_balls(z, r);
        if (i % 3 == 0)
            root = ask(half_space({0, 0.6, -0.8}, {0, -0.5 - 0.01 * random.uniform(), 0.3}), root, root);
        if (i % 3 == 1) root = cut(2, 0.79 + 0.01 * random.uniform(), kOutside, root);
        const SetTree tree = tree_of(root);
        const TreeBound found = bound_tree(tree, mesh, bvh, tolerance, {}, {});
        const bool wrong = samples_refute(tree, mesh, bvh, tolerance);
        if (wrong) {
            EXPECT_FALSE(found.certified) << i;
        }
        if (found.counter_examples.empty()) {
            EXPECT_FALSE(wrong) << i;
        }
        refuted += wrong;
    }
    EXPECT_GT(refuted, 3);
    EXPECT_LT(refuted, 15);
}

// ---- Meshes without sides ----

TEST(TreeBound, NoCertificateWhereSidesAreUndefined) {
    const SetTree tree = tree_of(ask(ball({}, 0.5), kInside, kOutside));
    for (const TriangleMesh& mesh : {shapes::open_cone(), shapes::moebius(), shapes::klein_bottle(),
                                     shapes::misoriented_sphere(), shapes::edge_fan()}) {
        const TreeBound found = bound(tree, shapes::scaled(mesh, {0.3, 0.3, 0.3}));
        EXPECT_FALSE(found.certified);
        EXPECT_FALSE(found.sides_defined);
    }
}

TEST(TreeBound, NoCertificateForShellsThatCross) {
    const TriangleMesh mesh =
        shapes::joined(shapes::sphere(4, 0.5, {0, 0, 0.3}), shapes::sphere(4, 0.5, {0, 0, -0.3}));
    EXPECT_FALSE(bound(tree_of(two_balls(0.3, 0.5)), mesh, 4e-3).certified);
}

// ---- As a long call ----

TEST(TreeBound, DoesNotDependOnTheNumberOfThreads) {
    const TriangleMesh mesh = two_balls_mesh(24, 64);
    const SetTree tree = tree_of(two_balls(0.3, 0.5 + 2e-3));
    Task one, three;
    one.threads = 1, three.threads = 3;
    const TreeBound a = bound(tree, mesh, 3e-3, {}, one), b = bound(tree, mesh, 3e-3, {}, three);
    EXPECT_EQ(a.certified, b.certified);
    EXPECT_EQ(a.proved, b.proved);
    EXPECT_EQ(a.counts.cells, b.counts.cells);
    EXPECT_EQ(a.counts.pieces, b.counts.pieces);
    const auto points = [](const TreeBound& found) {
        std::vector<Vec3> list;
        for (const auto* part : {&found.counter_examples, &found.labels, &found.missed})
            for (const LabelledPoint& p : *part) list.push_back(p.point);
        return list;
    };
    EXPECT_EQ(points(a), points(b));
}

TEST(TreeBound, FindsTheWayOutOfACrevice) {
    // Two balls that barely overlap: their surfaces meet at 3.6°.
    constexpr double kApart = 0.9995;
    const double crease = std::sqrt(1 - kApart * kApart);
    const SetTree tree = tree_of(two_balls(kApart, 1));
    const TreePruner pruner(tree);
    for (const double depth : {0.0005, 0.002, 0.0035}) {
        const Ball ball{{0, crease - depth, 0}, 0.004};
        EXPECT_TRUE(label_changes_near_quadrics(pruner, pruner.whole(), ball)) << depth;
    }
    EXPECT_FALSE(label_changes_near_quadrics(pruner, pruner.whole(), {{0, crease - 0.005, 0}, 0.004}));
}

TEST(TreeBound, TooManyCellsAreNoCertificate) {
    TreeBoundOptions options;
    options.max_cells = 2000;
    const TreeBound found = bound(tree_of(two_balls(0.3, 0.5)), two_balls_mesh(), kTolerance, options);
    EXPECT_FALSE(found.certified);
    EXPECT_FALSE(found.complete);
    EXPECT_LT(found.counts.cells, 20'000);
}

TEST(TreeBound, CanBeCancelled) {
    CancelToken cancel;
    Task task;
    task.cancel = &cancel;
    task.progress = [&](double, std::string_view) { cancel.cancel(); };
    EXPECT_THROW(bound(tree_of(two_balls(0.3, 0.5)), two_balls_mesh(), kTolerance, {}, task), Cancelled);
}

TEST(TreeBound, RefusesWhatMakesNoSense) {
    const SetTree tree = tree_of(kInside, 0.5);
    EXPECT_THROW(bound({}, shapes::cube(0.5)), InvalidInput);
    EXPECT_THROW(bound(tree, {}), InvalidInput);
    EXPECT_THROW(bound(tree, shapes::cube(0.5), 0), InvalidInput);
    EXPECT_THROW(bound(tree, shapes::cube(0.5), std::nan("")), InvalidInput);
}

}  // namespace
}  // namespace pfgeom
