// What curved mesh parts are fitted with: the nearest face of a patch, division of edges, missed points,
// lines.
#include "pfgeom/base/random.h"
#include "pfgeom/fit/collapse_error.h"
#include "pfgeom/fit/collapse_mesh.h"
#include "pfgeom/fit/feature_lines.h"
#include "pfgeom/fit/foot_point.h"
#include "pfgeom/fit/grid.h"
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

TEST(NearestFace, OfFlatOnesIsTheNearestOrOneBelowThePoint) {
    const CollapseMesh mesh(shapes::sphere(1));
    Patch patch;
    mesh.patch_of_move(0, mesh.point(0), patch);
    const double near = 0.05;
    const NearestFace nearest(patch, near);
    Random random(8);
    for (int i = 0; i < 2000; ++i) {
        Vec3 p = mesh.point(0);
        for (int axis = 0; axis < 3; ++axis) p[axis] += random.uniform() - 0.5;
        double least = 1e300;
        for (const auto& t : patch.triangles)
            least = std::min(least, squared_norm(closest_point_on_triangle(p, t[0], t[1], t[2]) - p));
        const auto found = nearest(p, static_cast<std::size_t>(i) % patch.after.size(), -1);
        EXPECT_GE(found.squared, least - 1e-15);
        if (found.squared > near * near) {
            EXPECT_NEAR(found.squared, least, 1e-15);
        }
        EXPECT_NEAR(squared_norm(p - found.point), found.squared, 1e-15);
    }
}

TEST(CollapseError, WhatNeedsNotBeToldApartChangesNoAnswer) {
    const TriangleMesh sphere = shapes::sphere(4);
    const CollapseError error(sphere, Metric::max, 0.05, 0.05, {});
    const CollapseMesh mesh(sphere);
    Random random(9);
    int within = 0;
    for (int i = 0; i < 400; ++i) {
        const auto v = static_cast<std::int32_t>(i);
        Vec3 p = mesh.point(v);
        for (int axis = 0; axis < 3; ++axis) p[axis] += 0.12 * random.uniform() - 0.06;
        Patch patch;
        mesh.patch_of_move(v, p, patch);
        const double exact = error.backward(patch, 0.045, -1);
        within += exact <= 0.045 ? 1 : 0;
        EXPECT_EQ(error.stays_near(patch, 0.045), exact <= 0.045);
        const double told = error.backward(patch, 0.045, 0.02);
        EXPECT_EQ(std::max(told, 0.02), std::max(exact, 0.02));
    }
    EXPECT_GT(within, 50);
    EXPECT_LT(within, 350);
}

TEST(VerticesOver, AreTheCornersOfFacesBeyondTheLimit) {
    const TriangleMesh sphere = shapes::sphere(3);
    CollapseMesh mesh(sphere);
    CollapseError error(sphere, Metric::max, 0.01, 0.01, {});
    const CollapseLimits limits{Metric::max, 0.01, 0.01, 2};
    EXPECT_TRUE(vertices_over(mesh, error, limits, {}).empty());
    Patch patch;
    mesh.patch_of_move(5, mesh.point(5) * 1.02, patch);
    error.commit(patch);
    mesh.move(5, patch);
    std::vector<std::int32_t> expected = mesh.neighbours(5);
    expected.push_back(5);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(vertices_over(mesh, error, limits, {}), expected);
}

TEST(CollapseMesh, DividesFlatFaces) {
    CollapseMesh mesh(shapes::cube());
    const TriangleMesh before = mesh.result();
    const std::int32_t middle = mesh.split(mesh.face(0)[0], mesh.face(0)[1]);
    EXPECT_EQ(mesh.face_count(), before.faces.size() + 2);
    EXPECT_NEAR(surface_area(mesh.result()), surface_area(before), 1e-12);
    EXPECT_EQ(mesh.faces_at(middle).size(), 4U);
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
    EXPECT_TRUE(missed_points(sphere, mesh, 1.002 * worst, {}).empty());
    const std::vector<MissedPoint> missed = missed_points(sphere, mesh, 0.97 * worst, {});
    ASSERT_FALSE(missed.empty());
    for (const MissedPoint& m : missed) {
        const double distance = std::sqrt(foot_point(m.p, surface(mesh, m.face)).squared);
        EXPECT_GT(distance, 0.97 * worst);
        EXPECT_NEAR(std::sqrt(m.squared), distance, 1e-3);
    }
}

TEST(MissedPoints, OfFlatFacesHardlyAnyIsLeft) {
    const TriangleMesh sphere = shapes::sphere(4);
    const CollapseMesh coarse(shapes::sphere(1));
    const TriangleMesh flat = coarse.result();
    const Bvh bvh(flat);
    double worst = 0;
    for (const Vec3& p : sphere.vertices) worst = std::max(worst, std::sqrt(bvh.closest(p).squared_distance));
    EXPECT_TRUE(missed_points(sphere, coarse, 1.002 * worst, {}).empty());
    const std::vector<MissedPoint> missed = missed_points(sphere, coarse, 0.97 * worst, {});
    ASSERT_FALSE(missed.empty());
    for (const MissedPoint& m : missed) {
        EXPECT_GT(m.squared, 0.97 * 0.97 * worst * worst);
        EXPECT_DOUBLE_EQ(m.squared, bvh.closest(m.p).squared_distance);
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
