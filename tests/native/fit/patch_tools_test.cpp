// What curved mesh parts are fitted with: the nearest face of a patch, division of edges, missed points,
// lines.
#include "pfgeom/base/random.h"
#include "pfgeom/fit/collapse_mesh.h"
#include "pfgeom/fit/feature_lines.h"
#include "pfgeom/fit/foot_point.h"
#include "pfgeom/fit/missed_points.h"
#include "pfgeom/fit/nearest_face.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// A sphere's icosahedron whose edges bulge onto it.
CollapseMesh bulging_icosahedron() {
    const TriangleMesh flat = shapes::sphere(0);
    CollapseMesh mesh(flat, true);
    for (std::size_t f = 0; f < flat.faces.size(); ++f) {
        const auto id = static_cast<std::int32_t>(f);
        const auto t = mesh.corners(id);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 middle = (t[k] + t[(k + 1) % 3]) * 0.5;
            mesh.set_bulge(id, k, normalized(middle) - middle);
        }
    }
    return mesh;
}

CurvedTriangle surface(const CollapseMesh& mesh, std::int32_t f) {
    return {mesh.corners(f), {mesh.bulge(f, 0), mesh.bulge(f, 1), mesh.bulge(f, 2)}};
}

TEST(NearestFace, IsNoFartherThanAnyOfThem) {
    const CollapseMesh mesh = bulging_icosahedron();
    Patch patch;
    mesh.patch_of_move(0, mesh.point(0), patch);
    const NearestFace nearest(patch, 0.05);
    Random random(7);
    for (int i = 0; i < 2000; ++i) {
        Vec3 p = mesh.point(0);
        for (int axis = 0; axis < 3; ++axis) p[axis] += 1.6 * random.uniform() - 0.8;
        double least = 1e300;
        for (std::size_t row = 0; row < patch.after.size(); ++row)
            least = std::min(least, foot_point(p, patch.surface(row)).squared);
        const auto found = nearest(p, static_cast<std::size_t>(i) % patch.after.size(), -1);
        EXPECT_NEAR(std::sqrt(found.squared), std::sqrt(least), 5e-3);
        EXPECT_NEAR(norm(p - patch.surface(found.row).at(found.weights)), std::sqrt(found.squared), 1e-12);
        EXPECT_LE(nearest(p, 0, 1e-2).squared, std::max(1e-2, found.squared + 1e-2));
    }
}

TEST(CollapseMesh, DividingAnEdgeLeavesTheSurface) {
    CollapseMesh mesh = bulging_icosahedron();
    const CollapseMesh before = mesh;
    const std::int32_t u = mesh.face(0)[0], v = mesh.face(0)[1];
    const std::int32_t middle = mesh.split(u, v);
    EXPECT_EQ(mesh.face_count(), before.face_count() + 2);
    EXPECT_EQ(mesh.faces_at(middle).size(), 4U);
    EXPECT_EQ(mesh.neighbours(middle).size(), 4U);
    EXPECT_TRUE(mesh.neighbours(middle, false).empty());
    for (std::size_t w = 0; w < mesh.vertex_count(); ++w)
        EXPECT_TRUE(mesh.neighbours(static_cast<std::int32_t>(w), false).empty()) << w;
    for (const std::int32_t f : mesh.faces_at(middle)) {
        const Vec3 p = surface(mesh, f).at({0.3, 0.25, 0.45});
        double least = 1e300;
        for (const std::int32_t g : before.faces_left())
            least = std::min(least, foot_point(p, surface(before, g)).squared);
        EXPECT_LT(std::sqrt(least), 1e-5);
    }
}

TEST(MissedPoints, AreThoseFartherThanTheLimit) {
    const CollapseMesh mesh = bulging_icosahedron();
    const TriangleMesh sphere = shapes::sphere(3);
    double worst = 0;
    for (const Vec3& p : sphere.vertices) {
        double least = 1e300;
        for (const std::int32_t f : mesh.faces_left())
            least = std::min(least, foot_point(p, surface(mesh, f)).squared);
        worst = std::max(worst, std::sqrt(least));
    }
    EXPECT_TRUE(missed_points(sphere, mesh, 1.02 * worst, {}).empty());
    const std::vector<MissedPoint> missed = missed_points(sphere, mesh, 0.8 * worst, {});
    ASSERT_FALSE(missed.empty());
    for (const MissedPoint& m : missed) {
        const double distance = std::sqrt(foot_point(m.p, surface(mesh, m.face)).squared);
        EXPECT_GT(distance, 0.8 * worst);
        EXPECT_NEAR(std::sqrt(m.squared), distance, 1e-3);
    }
}

TEST(FeatureLines, BordersAndCreasesButNotSmoothEdges) {
    const auto lines_at = [](const TriangleMesh& shape, std::int32_t v) {
        const CollapseMesh mesh(shape, true);
        Patch patch;
        mesh.patch_of_move(v, mesh.point(v), patch);
        const Spokes spokes = FeatureLines(shape, {}).spokes_of(patch, 1e-3);
        return std::count_if(spokes.list().begin(), spokes.list().end(),
                             [](const Spoke& s) { return s.line != nullptr; });
    };
    EXPECT_EQ(lines_at(shapes::sphere(2), 0), 0);
    EXPECT_EQ(lines_at(shapes::saddle(4), 0), 2);  // a corner of its border
    EXPECT_EQ(lines_at(shapes::cube(), 0), 3);     // not the diagonals
}

}  // namespace
}  // namespace pfgeom
