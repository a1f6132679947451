// Where the mesh lies, how many triangles it takes, and of what shape they are.
#include "fields.h"
#include "mesh_checks.h"
#include "pfgeom/polygonize/polygonize.h"

#include <algorithm>

namespace pfgeom::test {
namespace {

constexpr double kPi = 3.14159265358979;

TriangleMesh mesh_of(const ScalarField& field, double tolerance) {
    return polygonize(field, {.tolerance = tolerance, .min_depth = 3, .max_depth = 11});
}

void expect_good(const ScalarField& field, double tolerance, int euler) {
    const TriangleMesh mesh = mesh_of(field, tolerance);
    ASSERT_TRUE(is_closed_manifold(mesh));
    EXPECT_EQ(euler_characteristic(mesh), euler);
    const Fit fit = measure(field, mesh);
    EXPECT_LT(fit.vertex_max, 0.1 * tolerance);
    EXPECT_LT(fit.max, 1.1 * tolerance);
    EXPECT_GT(fit.rms, 0.3 * tolerance);  // no finer than asked for
    EXPECT_EQ(fit.flipped, 0);
    EXPECT_LT(fit.thin, 0.03);
    EXPECT_GT(fit.smallest_angle, 28);
}

TEST(Surface, LiesWithinTheTolerance) {
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        expect_good(sphere_field(0.8), tolerance, 2);
        expect_good(torus_field(0.6, 0.25), tolerance, 0);
        expect_good(ellipsoid_field({0.9, 0.5, 0.2}), tolerance, 2);
        expect_good(two_spheres_field(0.01), tolerance, 4);
    }
}

// Cells as small as the wall find it; the mesh must not keep their size.
TEST(Surface, ThinShell) {
    expect_good(shell_field(0.7, 0.06), 1e-3, 4);
}

// Equilateral triangles with corners on a sphere: chord ρ²/2R in the middle of one with circumradius ρ, and
// area 3√3/4 ρ², so at least 4.837 R/t triangles keep the chord within t.
TEST(Surface, TrianglesOfASphere) {
    for (const double tolerance : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4})
        EXPECT_LT(static_cast<double>(mesh_of(sphere_field(0.8), tolerance).faces.size()),
                  2.6 * 4.837 * 0.8 / tolerance);
}

TEST(Surface, FlatRegionsTakeFewTriangles) {
    // A plate with round edges: nearly all its area is flat.
    const FormulaField plate(
        [](const Vec3& p) {
            const Vec3 q = max(Vec3{std::abs(p.x) - 0.7, std::abs(p.y) - 0.7, std::abs(p.z) - 0.05}, {});
            return 0.1 - norm(q);
        },
        1);
    const TriangleMesh mesh = mesh_of(plate, 1e-3);
    EXPECT_TRUE(is_closed_manifold(mesh));
    EXPECT_LT(measure(plate, mesh).max, 1.1e-3);
    const auto flat = std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const Triangle& f) {
        return std::all_of(f.begin(), f.end(), [&](std::int32_t v) {
            return std::max(std::abs(mesh.vertices[v].x), std::abs(mesh.vertices[v].y)) < 0.7;
        });
    });
    EXPECT_LT(flat, 600);
    // Triangles as long as they are wide would take some 8000 on the rim, which is straight along four sides.
    EXPECT_LT(mesh.faces.size(), 6000U);
}

// Closed by the cube's faces, where the field goes on.
TEST(Surface, LeavesTheCube) {
    const FormulaField bar([](const Vec3& p) { return 0.5 - std::sqrt(p.y * p.y + p.z * p.z); }, 1);
    const TriangleMesh mesh = mesh_of(bar, 1e-2);
    EXPECT_TRUE(is_closed_manifold(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 2);
    double volume = 0;
    for (const Triangle& f : mesh.faces)
        volume += dot(mesh.vertices[f[0]], cross(mesh.vertices[f[1]], mesh.vertices[f[2]])) / 6;
    EXPECT_NEAR(volume, 2 * kPi * 0.25, 0.04);
    for (const Vec3& v : mesh.vertices)
        EXPECT_LE(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}), 1 + 1e-9);
}

TEST(Surface, HighGenus) {
    const FormulaField field = lattice_field(0.5, 0.1);
    const TriangleMesh mesh = polygonize(field, {.tolerance = 5e-3, .min_depth = 4, .max_depth = 6});
    EXPECT_TRUE(is_closed_manifold(mesh));
    // A graph of 4³ nodes and 3·4²·3 bars between them (those that leave the cube are stumps).
    EXPECT_EQ(euler_characteristic(mesh), 2 * (64 - 144));
}

TEST(Surface, UniformGrid) {
    const FormulaField field = sphere_field(0.8);
    const TriangleMesh mesh = polygonize(field, {.tolerance = 1e-2, .min_depth = 5, .max_depth = 5});
    EXPECT_TRUE(is_closed_manifold(mesh));
    const double cells = 8.04 * 1.5 / (2.0 / 32 * 2.0 / 32);  // area times mean of |nx|+|ny|+|nz|
    EXPECT_NEAR(static_cast<double>(mesh.faces.size()), 2 * cells, 0.1 * cells);
}

}  // namespace
}  // namespace pfgeom::test
