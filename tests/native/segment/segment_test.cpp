#include "pfgeom/segment/segment.h"

#include "pfgeom/segment/ellipsoid.h"
#include "pfgeom/segment/exact_patches.h"
#include "pfgeom/segment/region_set.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Every face once, and every region served by its quadric.
void expect_sound(const TriangleMesh& mesh, const std::vector<Region>& regions, double tolerance) {
    std::vector<int> seen(mesh.faces.size(), 0);
    for (const Region& region : regions) {
        EXPECT_TRUE(std::ranges::is_sorted(region.faces));
        for (const std::int32_t f : region.faces) {
            ++seen[f];
            for (const Vec3& p : check_points(mesh, f)) {
                EXPECT_LE(surface_distance(region.quadric, p), tolerance * (1 + 1e-9));
            }
        }
    }
    EXPECT_TRUE(std::ranges::all_of(seen, [](int n) { return n == 1; }));
    EXPECT_TRUE(std::ranges::is_sorted(regions, std::greater<>{}, &Region::area));
}

TEST(Segment, OppositeSidesOfACubeAreOneQuadric) {
    const TriangleMesh mesh = shapes::cube(0.8);
    const auto regions = segment(mesh, {0.001});
    EXPECT_EQ(regions.size(), 3U) << "slabs, such as x² = 0.64";
    expect_sound(mesh, regions, 0.001);
}

TEST(Segment, ACylinderIsAMantleAndASlab) {
    const TriangleMesh mesh = shapes::scaled(shapes::cylinder(128), {0.7, 0.7, 0.7});
    const auto regions = segment(mesh, {0.001});
    EXPECT_EQ(regions.size(), 2U);
    expect_sound(mesh, regions, 0.001);
}

TEST(Segment, AnEllipsoidIsOneRegion) {
    const TriangleMesh mesh = shapes::ellipsoid({0.9, 0.5, 0.15}, 5);
    const auto regions = segment(mesh, {0.002});
    EXPECT_EQ(regions.size(), 1U);
    expect_sound(mesh, regions, 0.002);
}

TEST(Segment, RegionsApartOnOneQuadricAreOne) {
    // Two slabs that both cubes share, and their four other sides in pairs.
    const TriangleMesh mesh = shapes::joined(shapes::cube(0.2, {-0.5, 0, 0}), shapes::cube(0.2, {0.5, 0, 0}));
    const auto regions = segment(mesh, {0.001});
    EXPECT_EQ(regions.size(), 4U);
    expect_sound(mesh, regions, 0.001);
    SegmentOptions without_hosts{0.001};
    without_hosts.hosts = 0;
    EXPECT_EQ(segment(mesh, without_hosts).size(), 12U) << "without looking for them";
}

TEST(Segment, ATighterToleranceTakesMoreRegions) {
    const TriangleMesh mesh = shapes::bumpy_sphere(4);
    const auto coarse = segment(mesh, {0.02}), fine = segment(mesh, {0.005});
    expect_sound(mesh, coarse, 0.02);
    expect_sound(mesh, fine, 0.005);
    EXPECT_LT(coarse.size(), fine.size());
}

TEST(Segment, GivesUpOnTooManyRegions) {
    const TriangleMesh mesh = shapes::bumpy_sphere(4);
    SegmentOptions options{0.005};
    const std::size_t regions = segment(mesh, options).size();
    options.most_regions = regions;
    EXPECT_EQ(segment(mesh, options).size(), regions);
    options.most_regions = regions - 1;
    EXPECT_TRUE(segment(mesh, options).empty());
}

TEST(Segment, DoesNotDependOnThreads) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    const auto one = segment(mesh, {0.01}, {1, nullptr, {}}), three = segment(mesh, {0.01}, {3, nullptr, {}});
    ASSERT_EQ(one.size(), three.size());
    for (std::size_t r = 0; r < one.size(); ++r) {
        EXPECT_EQ(one[r].faces, three[r].faces);
        EXPECT_EQ(one[r].quadric, three[r].quadric);
    }
}

TEST(Segment, CanBeCancelled) {
    CancelToken token;
    token.cancel();
    EXPECT_THROW(segment(shapes::sphere(4), {0.001}, {1, &token, {}}), Cancelled);
}

TEST(Segment, TheOutermostOfParallelPlanesArePairedFirst) {
    // Three plates, one on the other but for gaps: of their six sides the outermost are one slab.
    TriangleMesh mesh;
    for (const double z : {-0.5, 0.0, 0.5})
        mesh = shapes::joined(
            mesh, shapes::translated(shapes::scaled(shapes::cube(1), {0.6, 0.6, 0.1}), {0, 0, z}));
    SegmentOptions options{0.001};
    options.outermost_first = true;
    const auto regions = segment(mesh, options);
    expect_sound(mesh, regions, 0.001);
    const bool outermost = std::ranges::any_of(regions, [&](const Region& region) {
        return surface_distance(region.quadric, {0.2, 0.1, 0.6}) < 1e-6 &&
               surface_distance(region.quadric, {0.1, 0.3, -0.6}) < 1e-6;
    });
    EXPECT_TRUE(outermost);
}

TEST(SurfaceDistance, IsALowerBoundAtTheTipOfACone) {
    const Quadric blunt{{-1, -1, 1, 0, 0, 0, 0, 0, 0, -0.0004}};  // z² = x² + y² + 0.02²
    EXPECT_GT(surface_distance(blunt, {}), 0.01);
    EXPECT_LE(surface_distance(blunt, {}), 0.02);
    EXPECT_TRUE(within(blunt, {}, 0.02));
    EXPECT_FALSE(within(blunt, {}, 0.01));
    EXPECT_NEAR(surface_distance({{-1, -1, -1, 0, 0, 0, 0, 0, 0, 0.25}}, {0.501, 0, 0}), 0.001, 1e-5);
}

double share_of(const TriangleMesh& mesh) {
    return exact_share(mesh, find_exact_patches(mesh));
}

TEST(ExactPatches, ShareTellsTessellationsFromScans) {
    EXPECT_EQ(share_of(shapes::cylinder(64)), 1);
    EXPECT_EQ(share_of(shapes::ellipsoid({0.9, 0.5, 0.15}, 4)), 1);
    EXPECT_LT(share_of(shapes::bumpy_sphere(4)), 0.2);
}

TEST(ExactPatches, CoverTessellatedQuadrics) {
    // Coarse: the faces miss the ellipsoids by far more than the vertices do.
    const TriangleMesh mesh =
        shapes::joined(shapes::ellipsoid({0.4, 0.3, 0.2}, 3),
                       shapes::translated(shapes::ellipsoid({0.2, 0.3, 0.3}, 3), {1, 0, 0}));
    const auto patches = find_exact_patches(mesh);
    ASSERT_EQ(patches.size(), 2U);
    for (const ExactPatch& patch : patches) {
        EXPECT_EQ(patch.faces.size(), mesh.faces.size() / 2);
        ASSERT_TRUE(ellipsoid_of(patch.quadric));
        const Vec3 centre = ellipsoid_of(patch.quadric)->centre;
        EXPECT_NEAR(centre.x, centre.x < 0.5 ? 0 : 1, 1e-6);
        EXPECT_GT(patch.quadric.value(centre), 0) << "positive inside";
    }
}

TEST(ExactPatches, PiecesOfAnEllipsoidAreOne) {
    // Three rings of an ellipsoid, each too narrow to be worth having.
    TriangleMesh mesh = shapes::ellipsoid({0.8, 0.5, 0.4}, 3);
    std::erase_if(mesh.faces, [&](const Triangle& t) {
        const Vec3 p = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
        return std::abs(p.x) > 0.2 && std::abs(p.x) < 0.65;
    });
    const auto patches = find_exact_patches(mesh);
    ASSERT_EQ(patches.size(), 1U);
    EXPECT_EQ(patches[0].faces.size(), mesh.faces.size());
}

TEST(Ellipsoid, PointsLieOnIt) {
    // Oblique, and negative inside.
    const Quadric q{{3, 2, 5, 1, -0.5, 0.7, 0.4, -0.6, 0.2, -0.9}};
    const auto ellipsoid = ellipsoid_of(q);
    ASSERT_TRUE(ellipsoid);
    EXPECT_LT(q.value(ellipsoid->centre), 0);
    EXPECT_LT(norm(q.gradient(ellipsoid->centre)), 1e-14);
    const auto points = spread_points(*ellipsoid, 4);
    EXPECT_EQ(points.size(), 96U);
    for (const Vec3& p : points) EXPECT_NEAR(q.value(p), 0, 1e-14);
}

TEST(Ellipsoid, IsNothingElse) {
    EXPECT_FALSE(ellipsoid_of({{-1, -1, 0, 0, 0, 0, 0, 0, 0, 1}})) << "a cylinder";
    EXPECT_FALSE(ellipsoid_of({{-1, -1, 1, 0, 0, 0, 0, 0, 0, 1}})) << "a hyperboloid";
    EXPECT_FALSE(ellipsoid_of({{-1, -1, -1, 0, 0, 0, 0, 0, 0, -1}})) << "no point";
    EXPECT_FALSE(ellipsoid_of({{0, 0, 0, 0, 0, 0, 1, 0, 0, 0}})) << "a plane";
}

TEST(ExactPatches, AreNotFoundOnFreeForms) {
    EXPECT_TRUE(find_exact_patches(shapes::bumpy_sphere(4)).empty());
}

}  // namespace
}  // namespace pfgeom
