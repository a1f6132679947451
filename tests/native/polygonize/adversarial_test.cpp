// Shapes that are hard on purpose: what touches, what is thinner than the tolerance or a cell, what passes
// through the grid's own points, and pairs of random quadrics. All meshes are closed 2-manifolds.
#include "fields.h"
#include "mesh_checks.h"
#include "pfgeom/mesh/islands.h"
#include "pfgeom/polygonize/polygonize.h"
#include "trees.h"

#include <cstdlib>

namespace pfgeom::test {
namespace {

constexpr double kTolerance = 1e-3;

TriangleMesh mesh_of(const RegionPtr& region, double tolerance = kTolerance) {
    return polygonize(tree_of(region), {.tolerance = tolerance, .min_depth = 3, .max_depth = 10});
}

struct Shape {
    std::size_t pieces = 0;
    int genus = 0;  // of all of them together
};

Shape shape_of(const TriangleMesh& mesh) {
    EXPECT_TRUE(is_closed_manifold(mesh));
    const std::size_t pieces = find_pieces(mesh).size();
    return {pieces, static_cast<int>(pieces) - euler_characteristic(mesh) / 2};
}

// One point in common: one piece or two, but no handle. Apart or through each other by a thousandth of the
// tolerance likewise.
TEST(Adversarial, TouchingSpheres) {
    for (const double gap : {-1e-6, 0.0, 1e-6}) {
        const double off = 0.3 + gap / 2;
        const Shape tree =
            shape_of(mesh_of(either(where(turned({-off, 0.1, 0}, 0.3)), where(turned({off, 0.1, 0}, 0.3)))));
        EXPECT_LE(tree.pieces, 2U) << gap;
        EXPECT_EQ(tree.genus, 0) << gap;
        for (const int depth : {3, 5, 7}) {
            const Shape field = shape_of(polygonize(
                two_spheres_field(gap), {.tolerance = kTolerance, .min_depth = depth, .max_depth = depth}));
            EXPECT_LE(field.pieces, 2U) << gap;
            EXPECT_EQ(field.genus, 0) << gap;
        }
    }
}

// In a tree from a fifth of the tolerance on (kSnap); thinner ones may be missing, but what there is is
// closed.
TEST(Adversarial, ThinPlates) {
    for (const double share : {0.1, 0.3, 1.0, 3.0, 10.0}) {
        const double half = share * kTolerance / 2;
        for (const Vec3& n : {Vec3{0, 0, 1}, normalized({1, 2, 3})}) {
            const RegionPtr plate =
                both(both(where(half_space(n, half)), where(half_space(-n, half))), where(turned({}, 0.6)));
            const Shape shape = shape_of(mesh_of(plate));
            if (share > 0.2) {
                EXPECT_EQ(shape.pieces, 1U) << share;
                EXPECT_EQ(shape.genus, 0) << share;
            }
        }
    }
}

// As fields, from the finest cell on; thinner ones may be missing, but what there is is closed.
TEST(Adversarial, ThinShells) {
    for (const double share : {0.1, 0.3, 1.0, 3.0, 10.0}) {
        const TriangleMesh mesh =
            polygonize(shell_field(0.6, share * kTolerance), {.tolerance = kTolerance, .max_depth = 7});
        const Shape shape = shape_of(mesh);
        if (share * kTolerance > 2.0 / 128) {
            EXPECT_EQ(shape.pieces, 2U);
            EXPECT_EQ(shape.genus, 0);
        }
    }
}

// On a corner of the grid, in the middle of a cell, and in the middle of a face of one.
TEST(Adversarial, CubeCornersAtPointsOfTheGrid) {
    constexpr double kCell = 1.0 / 16;
    for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{0.5, 0.5, 0.5}, Vec3{0.5, 0.5, 0}, Vec3{0.25, 0.5, 0.75}}) {
        const Vec3 corner = at * kCell;
        const Shape tree = shape_of(mesh_of(box({-0.5, -0.5, -0.5}, corner)));
        EXPECT_EQ(tree.pieces, 1U);
        EXPECT_EQ(tree.genus, 0);
        const FormulaField field(
            [=](const Vec3& p) {
                const Vec3 d = p - corner;
                return std::min(-std::max({d.x, d.y, d.z}), 0.9 + std::min({p.x, p.y, p.z}));
            },
            1);
        for (const int depth : {5, 6}) {
            const Shape dual = shape_of(
                polygonize(field, {.tolerance = kTolerance, .min_depth = depth, .max_depth = depth}));
            EXPECT_EQ(dual.pieces, 1U);
            EXPECT_EQ(dual.genus, 0);
        }
    }
}

// Side by side along a common line, and across each other at a common point; united, and one cut off.
TEST(Adversarial, TangentCylinders) {
    const RegionPtr ends = both(where(half_space({0, 0, 1}, 0.5)), where(half_space({0, 0, -1}, 0.5)));
    const RegionPtr one = where(turned({-0.2, 0, 0}, 0.2, {0, 0, 1}));
    for (const RegionPtr& other :
         {where(turned({0.2, 0, 0}, 0.2, {0, 0, 1})), where(turned({0.2, 0, 0}, 0.2, {0, 1, 0}))}) {
        const RegionPtr room =
            both(ends, both(where(half_space({0, 1, 0}, 0.5)), where(half_space({0, -1, 0}, 0.5))));
        for (const RegionPtr& region : {either(one, other), without(one, other), without(other, one)}) {
            const Shape shape = shape_of(mesh_of(both(room, region)));
            EXPECT_LE(shape.pieces, 2U);
        }
    }
}

TEST(Adversarial, TorusAtTwoCellsATube) {
    for (int turn = 0; turn < 12; ++turn) {
        Random random(static_cast<std::uint64_t>(turn));
        const Vec3 shift{random.uniform() / 16, random.uniform() / 16, random.uniform() / 16};
        const FormulaField field(
            [=](const Vec3& p) {
                const Vec3 q = p - shift;
                const double from_axis = std::sqrt(q.x * q.x + q.y * q.y) - 0.6;
                return 1.0 / 16 - std::sqrt(from_axis * from_axis + q.z * q.z);
            },
            1);
        const Shape shape = shape_of(polygonize(field, {.tolerance = 0.02, .min_depth = 5, .max_depth = 5}));
        EXPECT_EQ(shape.pieces, 1U) << turn;
        EXPECT_EQ(shape.genus, 1) << turn;
    }
}

// xy = level is a saddle in every face that the z axis passes: the ambiguous cells, with the level at, above
// and below what a face's corners decide.
TEST(Adversarial, Saddles) {
    for (const double level : {0.0, 1e-9, -1e-9, 1e-3, -1e-3})
        for (const double shift : {0.0, 1.0 / 64, 1.0 / 32}) {
            Quadric q;
            q.c = {0, 0, 0, 1, 0, 0, -shift, -shift, 0, shift * shift - level};
            shape_of(mesh_of(both(where(q), box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}))));
            const FormulaField field(
                [=](const Vec3& p) {
                    return std::min(q.value(p),
                                    0.7 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
                },
                3);
            for (const int depth : {3, 4, 5})
                shape_of(polygonize(field, {.tolerance = 0.01, .min_depth = 3, .max_depth = depth}));
        }
}

Quadric random_quadric(Random& random) {
    const auto any = [&] { return 2 * random.uniform() - 1; };
    const Vec3 p{any(), any(), any()}, n = normalized({any(), any(), any()});
    switch (random.below(5)) {
        case 0:
            return half_space(n, 0.6 * any());
        case 1:
            return turned(p, 0.1 + 0.6 * random.uniform());
        case 2:
            return turned(p, 0.05 + 0.4 * random.uniform(), n);
        case 3:
            return turned(p, 0.05 + 0.4 * random.uniform(), n, any());
        default: {
            Quadric q;
            for (double& c : q.c) c = any();
            return q;
        }
    }
}

// Union, intersection and both differences in turn. PFGEOM_PAIRS=10000 runs the whole test.
TEST(Adversarial, PairsOfRandomQuadrics) {
    const char* given = std::getenv("PFGEOM_PAIRS");
    const int pairs = given ? std::atoi(given) : 400;
    std::size_t faces = 0;
    for (int i = 0; i < pairs; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const RegionPtr a = where(random_quadric(random)), b = where(random_quadric(random));
        const RegionPtr region = i % 4 == 0   ? either(a, b)
                                 : i % 4 == 1 ? both(a, b)
                                 : i % 4 == 2 ? without(a, b)
                                              : without(b, a);
        const TriangleMesh mesh =
            polygonize(tree_of(region), {.tolerance = 0.01, .min_depth = 2, .max_depth = 7});
        ASSERT_TRUE(is_closed_manifold(mesh)) << i;
        for (const Triangle& f : mesh.faces) {
            const Vec3& p = mesh.vertices[f[0]];
            ASSERT_FALSE(cross(mesh.vertices[f[1]] - p, mesh.vertices[f[2]] - p) == Vec3{}) << i;
        }
        faces += mesh.faces.size();
    }
    EXPECT_GT(faces, 100U * static_cast<std::size_t>(pairs));
}

}  // namespace
}  // namespace pfgeom::test
