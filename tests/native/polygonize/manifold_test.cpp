// The mesh is a closed 2-manifold for every field and every options.
#include "fields.h"
#include "mesh_checks.h"
#include "pfgeom/polygonize/polygonize.h"

namespace pfgeom::test {
namespace {

TriangleMesh mesh_of(const ScalarField& field, double tolerance, int min_depth, int max_depth) {
    return polygonize(field, {.tolerance = tolerance, .min_depth = min_depth, .max_depth = max_depth});
}

TEST(Manifold, RandomBumps) {
    std::size_t faces = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const double smallest = 0.1 + 0.3 * random.uniform();
        const BumpField field(seed, 30, smallest, 2 * smallest, 0.2 * random.uniform() - 0.1);
        const int min_depth = 2 + static_cast<int>(random.below(2));
        const int max_depth = min_depth + static_cast<int>(random.below(3));
        const double tolerance = 0.05 * random.uniform() * random.uniform() + 1e-4;
        const TriangleMesh mesh = mesh_of(field, tolerance, min_depth, max_depth);
        ASSERT_TRUE(is_closed_manifold(mesh)) << "seed " << seed;
        faces += mesh.faces.size();
    }
    EXPECT_GT(faces, 500'000U);  // the fields do have surface
}

// Nothing is continuous, ambiguous faces are everywhere, a fifth of the corners are exactly 0.
TEST(Manifold, Noise) {
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        const int depth = 2 + static_cast<int>(seed % 3);
        const NoiseField field(seed, 1 + static_cast<double>(seed % 7));
        ASSERT_TRUE(is_closed_manifold(mesh_of(field, 0.01, 2, depth))) << "seed " << seed;
    }
}

/// Drops the cells that another field's range would: real surface goes missing at their faces.
class WrongRange : public BumpField {
  public:
    using BumpField::BumpField;
    Interval range(const Box& box) const override {
        const double v = value(box.centre() + box.extent() * 0.3);
        return {v - 0.05, v + 0.05};
    }
};

TEST(Manifold, WrongRanges) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const WrongRange field(seed, 40, 0.2, 0.5, 0.05);
        ASSERT_TRUE(is_closed_manifold(mesh_of(field, 0.01, 2, 4))) << "seed " << seed;
    }
}

TEST(Manifold, ZeroAtCorners) {
    const FormulaField plane([](const Vec3& p) { return 0.5 - std::abs(p.x); }, 1);
    const FormulaField cube(
        [](const Vec3& p) {
            return 0.5 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        },
        1);
    const FormulaField octahedron(
        [](const Vec3& p) { return 0.5 - std::abs(p.x) - std::abs(p.y) - std::abs(p.z); }, 2);
    const FormulaField sheet([](const Vec3& p) { return -std::abs(p.z); }, 1);
    for (const FormulaField* field : {&plane, &cube, &octahedron, &sheet})
        for (int depth = 2; depth < 6; ++depth)
            for (int least = 2; least <= depth; ++least)
                EXPECT_TRUE(is_closed_manifold(mesh_of(*field, 0.01, least, depth)));
}

TEST(Manifold, NotANumber) {
    const FormulaField field([](const Vec3& p) { return p.x < 0 ? std::sqrt(p.x) : 0.5 - norm(p); }, 100);
    EXPECT_TRUE(is_closed_manifold(mesh_of(field, 0.01, 2, 5)));
}

TEST(Manifold, EmptyAndFull) {
    const FormulaField nothing([](const Vec3&) { return -1.0; }, 0),
        everything([](const Vec3&) { return 1.0; }, 0);
    EXPECT_TRUE(mesh_of(nothing, 0.01, 2, 5).faces.empty());
    const TriangleMesh cube = mesh_of(everything, 0.05, 2, 5);
    EXPECT_TRUE(is_closed_manifold(cube));
    EXPECT_EQ(euler_characteristic(cube), 2);
}

}  // namespace
}  // namespace pfgeom::test
