#include "pfgeom/fit/curved_part.h"

#include "pfgeom/base/error.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/report/deviation.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

Object curved(const TriangleMesh& mesh, double tolerance, double share = 1, Metric metric = Metric::max) {
    return fit_mesh_part(mesh, {tolerance, metric, share, true});
}

double reached(const TriangleMesh& mesh, const Object& object, double tolerance) {
    const TriangleMesh result = mesh_of(object, {.chord = tolerance / 100});
    return measure_deviation(mesh, result, {.samples = 20'000}).max() / tolerance;
}

std::size_t faces(const Object& object) {
    return std::get<MeshPart>(object.shape).faces.size();
}

TEST(CurvedPart, KeepsTheToleranceOnShapesOfEveryKind) {
    for (const TriangleMesh& mesh :
         {shapes::cube(), shapes::sphere(2), shapes::cylinder(), shapes::saddle(10), shapes::moebius(24),
          shapes::misoriented_sphere(), shapes::edge_fan(), shapes::cubes_sharing_edge(),
          shapes::sliver_fan()}) {
        const double tolerance = 1e-2 * diagonal(mesh);
        SCOPED_TRACE(testing::Message() << mesh.faces.size() << " faces");
        const double first = reached(mesh, curved(mesh, tolerance), tolerance);
        EXPECT_LE(first, 1.3);
        if (first > 1) {  // what the closed loop then does
            EXPECT_LE(reached(mesh, curved(mesh, tolerance, 0.7), tolerance), 1);
        }
    }
}

TEST(CurvedPart, ASingleQuadIsTwoFlatFaces) {
    const Object object = curved(shapes::saddle(1, 0), 1e-3);
    EXPECT_EQ(faces(object), 2U);
    for (const Bulge& b : std::get<MeshPart>(object.shape).bulges) EXPECT_EQ(b, Bulge{});
}

TEST(CurvedPart, RoundShapesTakeLessThanHalfTheFaces) {
    for (const TriangleMesh& mesh : {shapes::sphere(3), shapes::saddle(24)}) {
        const double tolerance = 5e-3 * diagonal(mesh);
        EXPECT_LT(2 * faces(curved(mesh, tolerance)),
                  faces(fit_mesh_part(mesh, {tolerance, Metric::max, 1})));
    }
}

// A flat ring: its borders, one of them concave from the inside, are all that there is.
TEST(CurvedPart, RoundBordersTakeFewFaces) {
    constexpr int kAround = 96;
    TriangleMesh ring;
    for (const double radius : {1.0, 0.8, 0.6}) {
        for (int i = 0; i < kAround; ++i) {
            const auto [x, y] = shapes::on_circle(static_cast<double>(i) / kAround);
            ring.vertices.push_back({radius * x, radius * y, 0});
        }
    }
    ring.faces = shapes::grid_faces(3, kAround, false, true);
    const double tolerance = 2e-3 * diagonal(ring);
    const Object object = curved(ring, tolerance);
    EXPECT_LE(reached(ring, object, tolerance), 1);
    EXPECT_LE(faces(object), 32U);
    EXPECT_LT(2 * faces(object), faces(fit_mesh_part(ring, {tolerance, Metric::max, 1})));
}

TEST(CurvedPart, RmsTakesFewerFacesThanTheSameMaximum) {
    const TriangleMesh mesh = shapes::bumpy_sphere(2);
    const double tolerance = 2e-2;
    const Object object = curved(mesh, tolerance, 1, Metric::rms);
    const TriangleMesh result = mesh_of(object, {.chord = 1e-4});
    EXPECT_LE(measure_deviation(mesh, result, {.samples = 20'000}).rms(), 1.1 * tolerance);
    EXPECT_LT(faces(object), faces(curved(mesh, tolerance)));
}

// Closed, creased, open, with an edge of three faces, and by the other metric.
TEST(CurvedPart, DoesNotDependOnThreads) {
    const auto fit = [](const TriangleMesh& mesh, double share, Metric metric, int threads) {
        Task task;
        task.threads = threads;
        return std::get<MeshPart>(fit_mesh_part(mesh, {share * diagonal(mesh), metric, 1, true}, task).shape);
    };
    const auto compare = [&](const TriangleMesh& mesh, double share, Metric metric) {
        SCOPED_TRACE(testing::Message() << mesh.faces.size() << " faces");
        const MeshPart one = fit(mesh, share, metric, 1), three = fit(mesh, share, metric, 3);
        EXPECT_EQ(one.positions, three.positions);
        EXPECT_EQ(one.faces, three.faces);
        EXPECT_EQ(one.bulges, three.bulges);
    };
    compare(shapes::bumpy_sphere(2), 4e-3, Metric::max);
    compare(shapes::cylinder(), 1e-2, Metric::max);
    compare(shapes::saddle(10), 3e-3, Metric::max);
    compare(shapes::edge_fan(), 2e-2, Metric::max);
    compare(shapes::bumpy_sphere(1), 1e-2, Metric::rms);
}

TEST(CurvedPart, StopsWhenCancelled) {
    CancelToken token;
    token.cancel();
    Task cancelled;
    cancelled.cancel = &token;
    EXPECT_THROW(fit_mesh_part(shapes::bumpy_sphere(2), {1e-2, Metric::max, 1, true}, cancelled), Cancelled);
}

}  // namespace
}  // namespace pfgeom
