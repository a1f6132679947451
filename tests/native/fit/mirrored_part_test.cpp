// Mesh parts of which one half is fitted and the other is its image.
#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/fit/simplify.h"
#include "pfgeom/report/deviation.h"
#include "polygonize/mesh_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfgeom {
namespace {

// Open, with a sharp fold along x = 0.
TriangleMesh hood() {
    TriangleMesh mesh = shapes::saddle(24);
    for (Vec3& v : mesh.vertices) v.z = 0.3 * v.y * v.y * v.y - 0.2 * v.x * v.x - 0.3 * std::abs(v.x);
    return mesh;
}

Object fitted(const TriangleMesh& mesh, double tolerance, bool curved, bool mirrored = true) {
    MeshPartOptions options{tolerance, Metric::max, 1, curved, {}};
    if (mirrored) options.mirror = AxisPlane{0, 0};
    return fit_mesh_part(mesh, options);
}

std::size_t faces(const Object& object) {
    return std::get<MeshPart>(object.shape).faces.size();
}

double reached(const TriangleMesh& mesh, const Object& object, double tolerance) {
    const TriangleMesh result = mesh_of(object, {.chord = tolerance / 100});
    return measure_deviation(mesh, result, {.samples = 20'000}).max() / tolerance;
}

TEST(MirroredPart, BothHalvesKeepTheTolerance) {
    for (const TriangleMesh& mesh : {shapes::casting(), hood(), shapes::torus(), shapes::cylinder()}) {
        const double tolerance = 5e-3 * diagonal(mesh);
        for (const bool curved : {false, true}) {
            SCOPED_TRACE(testing::Message() << mesh.faces.size() << " faces, curved: " << curved);
            const Object half = fitted(mesh, tolerance, curved),
                         whole = fitted(mesh, tolerance, curved, false);
            EXPECT_LE(reached(mesh, half, tolerance), 1.2);
            EXPECT_LT(faces(half), 0.7 * static_cast<double>(faces(whole)));
        }
    }
}

TEST(MirroredPart, AClosedSurfaceComesBackClosed) {
    for (const TriangleMesh& mesh : {shapes::casting(), shapes::torus(), shapes::cylinder()}) {
        for (const double share : {1e-2, 5e-3}) {
            for (const bool curved : {false, true}) {
                const Object half = fitted(mesh, share * diagonal(mesh), curved);
                EXPECT_TRUE(test::is_closed_manifold(mesh_of(half, {.chord = share})));
            }
        }
    }
}

TEST(MirroredPart, IsExactlySymmetric) {
    const Object half = fitted(hood(), 1e-3, true);
    const TriangleMesh mesh = mesh_of(half, {.chord = 1e-3});
    const auto& plane = *std::get<MeshPart>(half.shape).mirror;
    Vec3 local;
    local[plane.axis] = plane.at;
    const double at = half.frame.to_world(local).x;
    std::vector<std::array<double, 3>> places, images;
    for (const Vec3& v : mesh.vertices) {
        places.push_back({v.x, v.y, v.z});
        images.push_back({2 * at - v.x, v.y, v.z});
    }
    std::sort(places.begin(), places.end());
    std::sort(images.begin(), images.end());
    EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << "the cut is joined";
    std::size_t above = 0, on = 0;
    for (const auto& p : places) above += p[0] > at ? 1 : 0, on += p[0] == at ? 1 : 0;
    EXPECT_EQ(2 * above + on, places.size());
    EXPECT_GT(on, 10U);
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(places[i][k], images[i][k], 1e-15);
    }
}

// Halves that differ by half of the tolerance: the part passes between them.
TEST(MirroredPart, NearlySymmetricHalvesShareTheTolerance) {
    TriangleMesh mesh = shapes::casting();
    const double tolerance = 5e-3 * diagonal(mesh);
    for (Vec3& v : mesh.vertices) {
        if (v.x > 0) v *= 1 + 0.5 * tolerance * v.x * v.x;
    }
    for (const bool curved : {false, true})
        EXPECT_LE(reached(mesh, fitted(mesh, tolerance, curved), tolerance), 1.2);
}

TEST(MirroredPart, IsTheSameEachTime) {
    const Object a = fitted(shapes::casting(), 1e-2, true), b = fitted(shapes::casting(), 1e-2, true);
    EXPECT_EQ(a, b);
    EXPECT_EQ(canonical(std::get<MeshPart>(a.shape)), canonical(std::get<MeshPart>(b.shape)));
}

}  // namespace
}  // namespace pfgeom
