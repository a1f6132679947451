// The offset of a model against the distance field of its mesh.
#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/mesh/bvh.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

Model compressed(const TriangleMesh& mesh, double tolerance) {
    return compress(mesh, {.tolerance = tolerance}).model;
}

// Of the offset's vertices and the middles of its faces, from the surface at the distance.
double largest_miss(const Model& result, const Model& model, double distance) {
    const TriangleMesh mesh = to_mesh(result);
    const Bvh original(to_mesh(model));
    double most = 0;
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        for (const Vec3& p : {a, (a + b + c) / 3})
            most = std::max(most, std::abs(original.signed_distance(p) + distance));
    }
    return most;
}

TEST(Offset, KeepsItsPromiseBothWays) {
    const Model torus = compressed(shapes::torus(1, 0.4, 32, 16), 1e-2);
    for (const double share : {0.03, -0.03}) {
        const double distance = share * torus.diagonal;
        const Compressed result = offset(torus, distance, {.tolerance = 1e-2, .effort = Effort::fast});
        const Promise& promise = result.model.promise;
        EXPECT_NEAR(promise.tolerance, 1e-2 * torus.diagonal, 1e-6 * torus.diagonal);
        EXPECT_LE(promise.bound_mesh, promise.tolerance);
        EXPECT_LE(largest_miss(result.model, torus, distance), promise.bound_mesh);
        EXPECT_FALSE(promise.certified);
        EXPECT_EQ(encode(result.model), result.bytes);
    }
}

TEST(Offset, OfRmsToo) {
    const Model torus = compressed(shapes::torus(1, 0.4, 32, 16), 1e-2);
    const Compressed result =
        offset(torus, 0.05, {.tolerance = 4e-3, .metric = Metric::rms, .effort = Effort::fast});
    EXPECT_EQ(result.model.promise.metric, Metric::rms);
    EXPECT_LE(result.model.promise.rms, result.model.promise.tolerance);
    EXPECT_LE(largest_miss(result.model, torus, 0.05), result.model.promise.bound_mesh);
}

TEST(Offset, OfASphereIsAQuadric) {
    const Model ball = compressed(shapes::sphere(4, 1.0), 5e-3);
    for (const double distance : {-0.5, 0.5, 3.0}) {
        const Compressed result = offset(ball, distance, {.tolerance = 5e-3});
        EXPECT_EQ(count_functions(result.model).surface, 1);
        for (const Vec3& v : to_mesh(result.model).vertices) EXPECT_NEAR(norm(v), 1 + distance, 0.04);
    }
}

TEST(Offset, DoesNotDependOnThreads) {
    const Model torus = compressed(shapes::torus(1, 0.4, 24, 12), 1e-2);
    const CompressOptions options{.tolerance = 1e-2, .effort = Effort::fast};
    EXPECT_EQ(offset(torus, 0.1, options, quiet({}, 1)).bytes,
              offset(torus, 0.1, options, quiet({}, 2)).bytes);
}

TEST(Offset, NamesWhatItCannotDo) {
    const Model ball = compressed(shapes::sphere(3, 1.0), 1e-2);
    EXPECT_THROW(offset(ball, -1.5, {}), InvalidInput);  // nothing left
    EXPECT_THROW(offset(ball, std::numeric_limits<double>::quiet_NaN(), {}), InvalidInput);
    EXPECT_THROW(offset(ball, std::numeric_limits<double>::infinity(), {}), InvalidInput);
    EXPECT_THROW(offset(ball, 1e300, {}), InvalidInput);
    EXPECT_THROW(offset(ball, 0.1, {.tolerance = 0}), InvalidInput);
    EXPECT_THROW(offset(Model{}, 0.1, {}), InvalidInput);
    CancelToken token;
    token.cancel();
    EXPECT_THROW(offset(ball, 0.1, {}, {1, &token, {}}), Cancelled);
}

}  // namespace
}  // namespace pfgeom
