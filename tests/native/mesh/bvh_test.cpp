#include "pfgeom/mesh/bvh.h"

#include "pfgeom/base/random.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Vec3 random_point(Random& random, double half) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    return Vec3{2 * x - 1, 2 * y - 1, 2 * z - 1} * half;
}

// What closest() promises, without a hierarchy.
ClosestPoint closest_of_all(const TriangleMesh& mesh, const Vec3& p) {
    ClosestPoint best;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const auto& [a, b, c] = mesh.faces[i];
        const Vec3 q = closest_point_on_triangle(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
        if (squared_norm(q - p) < best.squared_distance) {
            best = {static_cast<std::int32_t>(i), q, squared_norm(q - p)};
        }
    }
    return best;
}

void expect_same(const ClosestPoint& a, const ClosestPoint& b) {
    EXPECT_EQ(a.face, b.face);
    EXPECT_EQ(a.point, b.point);
    EXPECT_EQ(a.squared_distance, b.squared_distance);
}

TEST(ClosestPointOnTriangle, AllSevenRegions) {
    const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
    const auto closest = [&](const Vec3& p) { return closest_point_on_triangle(p, a, b, c); };
    EXPECT_EQ(closest({-1, -2, 3}), a);
    EXPECT_EQ(closest({6, 1, 1}), b);
    EXPECT_EQ(closest({1, 6, -1}), c);
    EXPECT_EQ(closest({1, -2, 1}), (Vec3{1, 0, 0}));
    EXPECT_EQ(closest({-2, 3, 1}), (Vec3{0, 3, 0}));
    EXPECT_EQ(closest({3, 3, 5}), (Vec3{2, 2, 0}));
    EXPECT_EQ(closest({1, 1, 9}), (Vec3{1, 1, 0}));
}

TEST(ClosestPointOnTriangle, TrianglesWithoutAreaAreSegmentsAndPoints) {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{3, 0, 0};
    EXPECT_EQ(closest_point_on_triangle({2, 5, 0}, a, b, c), (Vec3{2, 0, 0}));
    EXPECT_EQ(closest_point_on_triangle({0.5, 5, 0}, c, a, b), (Vec3{0.5, 0, 0}));
    EXPECT_EQ(closest_point_on_triangle({2, 5, 0}, a, a, c), (Vec3{2, 0, 0}));
    EXPECT_EQ(closest_point_on_triangle({2, 5, 0}, c, a, a), (Vec3{2, 0, 0}));
    EXPECT_EQ(closest_point_on_triangle({2, 5, 0}, b, b, b), b);
}

TEST(ClosestPointOnTriangle, NeedlesKeepTheirDigits) {
    Random random(1);
    for (const double width : {1e-3, 1e-5, 1e-7, 1e-9}) {
        const Vec3 a{0, 0, 0}, b{1, 0.3, 0.2}, c = b * 0.7 + Vec3{0, width, 0};
        for (int i = 0; i < 200; ++i) {
            const double u = random.uniform(), v = (1 - u) * random.uniform();
            const Vec3 on = b * u + c * v, p = on + normalized(cross(b, c)) * (0.1 * width);
            const double distance = norm(closest_point_on_triangle(p, a, b, c) - p);
            EXPECT_NEAR(distance, 0.1 * width, 1e-3 * width);
        }
    }
}

TEST(Bvh, EqualsSearchOfAllFaces) {
    Random random(2);
    for (const TriangleMesh& mesh :
         {shapes::bumpy_sphere(3), shapes::cube(), shapes::moebius(), shapes::sliver_fan(),
          shapes::scene_of_islands(16), shapes::edge_fan(1)}) {
        const Bvh bvh(mesh);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = random_point(random, i % 2 ? 1.1 : 3);
            expect_same(bvh.closest(p), closest_of_all(mesh, p));
        }
    }
}

TEST(Bvh, TiesGoToTheLowestFaceWhateverTheHint) {
    const TriangleMesh mesh = shapes::joined(shapes::sphere(2), shapes::sphere(2));  // everything twice
    const Bvh bvh(mesh);
    const auto faces = static_cast<std::int32_t>(mesh.faces.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); v += 5) {
        for (const double scale : {0.0, 0.5, 1.0, 2.0}) {
            const Vec3 p = mesh.vertices[v] * scale;
            const ClosestPoint truth = closest_of_all(mesh, p);
            EXPECT_LT(truth.face, faces / 2);
            for (const std::int32_t hint : {-1, 0, faces - 1, truth.face + faces / 2, faces, 1 << 30}) {
                expect_same(bvh.closest(p, kInf, hint), truth);
            }
        }
    }
}

TEST(Bvh, LooksOnlyAsFarAsWithin) {
    const Bvh bvh(shapes::cube());
    EXPECT_EQ(bvh.closest({0, 0, 3}, 1.999).face, -1);
    EXPECT_EQ(bvh.closest({0, 0, 3}, 1.999, 0).face, -1);
    const ClosestPoint found = bvh.closest({0.25, 0.5, 3}, 2);
    EXPECT_GE(found.face, 0);
    EXPECT_EQ(found.point, (Vec3{0.25, 0.5, 1}));
    EXPECT_EQ(found.squared_distance, 4);
}

TEST(Bvh, FacesWithinADistance) {
    const TriangleMesh mesh = shapes::cube();
    const Bvh bvh(mesh);
    std::vector<std::int32_t> faces;
    bvh.faces_within({0.3, 0.1, 1}, 1e-9, faces);  // inside one triangle of the top
    EXPECT_EQ(faces.size(), 1U);
    faces.clear();
    bvh.faces_within({1, 0.1, 1}, 1e-9, faces);  // on an edge
    EXPECT_EQ(faces.size(), 2U);
    faces.clear();
    bvh.faces_within({0, 0, 0}, 0.999, faces);
    EXPECT_TRUE(faces.empty());
    bvh.faces_within({0, 0, 0}, 1.001, faces);
    EXPECT_EQ(faces.size(), 12U);
}

TEST(Bvh, FarFromTheOriginAndWithAStrayVertex) {
    TriangleMesh mesh = shapes::translated(shapes::sphere(3, 1e-3), {5e6, -3e6, 100});
    shapes::append(mesh, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    const Bvh bvh(mesh);
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const Vec3 p = Vec3{5e6, -3e6, 100} + random_point(random, 2e-3);
        expect_same(bvh.closest(p), closest_of_all(mesh, p));
    }
}

TEST(Bvh, EmptyAndContrivedMeshes) {
    const Bvh none{TriangleMesh{}};
    EXPECT_EQ(none.closest({1, 2, 3}).face, -1);
    EXPECT_EQ(none.first_hit({}, {0, 0, 1}).face, -1);
    EXPECT_EQ(none.winding_number({}), 0);
    EXPECT_TRUE(none.bounds().empty());

    TriangleMesh same{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
    same.faces.assign(5000, {0, 1, 2});
    EXPECT_EQ(Bvh(same).closest({0.2, 0.2, 7}, kInf, 4321).face, 0);

    TriangleMesh huge =
        shapes::scaled(shapes::cube(), {1e300, 1e308, 1e-310});       // squares overflow: no answer,
    EXPECT_EQ(Bvh(huge).closest({1e300, 1e300, 1e300}, 1).face, -1);  // but no harm either

    TriangleMesh geometric;  // each triangle a hundredth of the one before: no bins separate them evenly
    double size = 1;
    for (std::int32_t i = 0; i < 120; ++i, size *= 0.01) {
        geometric.vertices.insert(geometric.vertices.end(), {{size, 0, 0}, {size, size, 0}, {size, 0, size}});
        geometric.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    expect_same(Bvh(geometric).closest({0.5, 1, 1}), closest_of_all(geometric, {0.5, 1, 1}));
}

TEST(Bvh, RaysMeetASphereWhereTheyShould) {
    const TriangleMesh mesh = shapes::sphere(4);
    const Bvh bvh(mesh);
    Random random(4);
    for (int i = 0; i < 500; ++i) {
        const Vec3 direction = normalized(random_point(random, 1)) * 0.7;
        const RayHit hit = bvh.first_hit({}, direction);
        ASSERT_GE(hit.face, 0);
        EXPECT_NEAR(norm(direction * hit.t), 1, 0.01);
        EXPECT_EQ(bvh.first_hit({}, direction, 0, hit.t * 0.999).face, -1);
        EXPECT_EQ(bvh.first_hit({}, direction, hit.t * 1.001).face, -1);
        EXPECT_NEAR(bvh.first_hit(-3 * direction, direction).t, 3 - hit.t, 0.05);
    }
}

TEST(Bvh, NoRaySlipsThroughEdgesAndVertices) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    const Bvh bvh(mesh);
    for (const auto& [a, b, c] : mesh.faces) {
        for (const Vec3& target : {mesh.vertices[a], (mesh.vertices[a] + mesh.vertices[b]) * 0.5,
                                   mesh.vertices[b] * 0.3 + mesh.vertices[c] * 0.7}) {
            EXPECT_GE(bvh.first_hit({0.01, 0.02, 0.03}, target - Vec3{0.01, 0.02, 0.03}).face, 0);
        }
    }
}

TEST(Bvh, AxisParallelRaysAlongFlatBoxes) {
    const Bvh bvh(shapes::cube());
    EXPECT_EQ(bvh.first_hit({0.25, 0.5, 5}, {0, 0, -1}).t, 4);
    EXPECT_EQ(bvh.first_hit({1, 0.5, 5}, {0, 0, -2}).t, 2);  // along a side, onto the top's border
    EXPECT_EQ(bvh.first_hit({1.001, 0.5, 5}, {0, 0, -1}).face, -1);
}

// Its only node has children without faces.
TEST(Bvh, RaysOfMeshesOfOneToFourFaces) {
    const TriangleMesh whole = shapes::cube(1);
    for (std::size_t count = 1; count <= 4; ++count) {
        TriangleMesh mesh{whole.vertices,
                          {whole.faces.begin(), whole.faces.begin() + static_cast<long>(count)}};
        const Bvh bvh(mesh);
        Random random(count);
        for (int i = 0; i < 200; ++i) {
            const Vec3 from = random_point(random, 3), to = random_point(random, 1);
            const RayHit hit = bvh.first_hit(from, to - from);
            const RayHit back = bvh.first_hit(to, from - to, 0, 1);
            if (hit.face < 0) continue;
            EXPECT_NEAR(std::abs((from + hit.t * (to - from)).z), 1, 1e-12);
            EXPECT_EQ(hit.t <= 1, back.face >= 0);
        }
        EXPECT_EQ(bvh.first_hit({0, 0, 5}, {1e-3, 2e-3, 1}).face, -1);
    }
}

TEST(Bvh, WindingNumberOfClosedSurfaces) {
    Random random(5);
    for (const TriangleMesh& mesh : {shapes::sphere(4), shapes::torus(), shapes::cube()}) {
        const Bvh bvh(mesh);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = random_point(random, 1.6);
            if (closest_of_all(mesh, p).squared_distance < 1e-4) continue;
            const double exact = bvh.winding_number(p, kInf);
            EXPECT_NEAR(exact, exact > 0.5 ? 1 : 0, 1e-12);
            EXPECT_NEAR(bvh.winding_number(p), exact, 0.05);
        }
    }
    EXPECT_NEAR(Bvh(shapes::flipped(shapes::cube())).winding_number({}), -1, 1e-12);
    EXPECT_NEAR(Bvh(shapes::nested_shells(3)).winding_number({}), 1, 0.05);
    EXPECT_NEAR(Bvh(shapes::nested_shells(2)).winding_number({}), 0, 0.05);
}

TEST(Bvh, WindingNumberAtAHoleIsAHalf) {
    TriangleMesh mesh = shapes::cube();
    mesh.faces.erase(mesh.faces.begin() + 2, mesh.faces.begin() + 4);  // no top
    EXPECT_NEAR(Bvh(mesh).winding_number({0, 0, 1}, kInf), 0.5, 1e-12);
    EXPECT_NEAR(Bvh(mesh).winding_number({}, kInf), 5.0 / 6, 1e-12);
}

TEST(Bvh, SignedDistanceOfACube) {
    const Bvh bvh(shapes::cube());
    EXPECT_DOUBLE_EQ(bvh.signed_distance({0.25, 0, 0}), 0.75);
    EXPECT_DOUBLE_EQ(bvh.signed_distance({3, 0, 0}), -2);
    EXPECT_DOUBLE_EQ(bvh.signed_distance({4, 5, 1}), -5);
}

}  // namespace
}  // namespace pfgeom
