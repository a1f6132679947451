// Symmetric shapes become a half and its image, where that takes fewer bytes.
#include "pfgeom/algebra/algebra.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/mesh/bvh.h"
#include "placed_shapes.h"
#include "polygonize/mesh_checks.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

// Symmetric in x = 0; closed and creased, its sides of no quadrics.
TriangleMesh casting() {
    TriangleMesh mesh = shapes::casting();
    for (Vec3& v : mesh.vertices) v.z = std::max(v.z, -0.4 + 0.1 * v.y * v.y * v.y);
    return mesh;
}

TriangleMesh panel() {
    TriangleMesh mesh = shapes::saddle(20);
    for (Vec3& v : mesh.vertices)
        v.z = 0.3 * v.y * v.y * v.y - 0.2 * v.x * v.x + 0.1 * v.x * v.x * v.x * v.x * v.y;
    return mesh;
}

Compressed compressed(const TriangleMesh& mesh, double tolerance = 2e-3) {
    return compress(mesh, {.tolerance = tolerance});
}

const MeshPart& part_of(const Compressed& c) {
    return std::get<MeshPart>(c.model.objects.at(0).shape);
}

// The same shape with one half scaled a little in z has no mirror, and shows what both halves take.
TriangleMesh lopsided(TriangleMesh mesh) {
    for (Vec3& v : mesh.vertices) {
        if (v.x > 0) v.z *= 1 + 0.2 * v.x;
    }
    return mesh;
}

// Of these small files a third is no mesh.
TEST(MirroredModel, TakesFewerBytes) {
    for (const TriangleMesh& mesh : {casting(), panel()}) {
        const Compressed half = compressed(mesh), whole = compressed(lopsided(mesh));
        ASSERT_TRUE(part_of(half).mirror);
        ASSERT_FALSE(part_of(whole).mirror);
        EXPECT_LT(static_cast<double>(half.bytes.size()), 0.85 * static_cast<double>(whole.bytes.size()));
        EXPECT_TRUE(half.model.promise.certified);
        EXPECT_LE(half.model.promise.bound_mesh, half.model.promise.tolerance);
        const Deviation d = measure_deviation(mesh, to_mesh(*decode(half.bytes)), {.samples = 50'000});
        EXPECT_LE(d.max(), half.model.promise.tolerance);
        EXPECT_LT(d.normals().mean, 5) << "the faces look the same way";
    }
}

TEST(MirroredModel, AnswersLikeAnyOther) {
    const TriangleMesh mesh = casting();
    const Compressed c = compressed(mesh);
    ASSERT_TRUE(part_of(c).mirror);
    const TriangleMesh rebuilt = to_mesh(c.model);
    EXPECT_TRUE(test::is_closed_manifold(rebuilt));
    const ModelField field(c.model);
    const Bvh bvh(mesh);
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const Vec3 p{3 * random.uniform() - 1.5, 3 * random.uniform() - 1.5, 3 * random.uniform() - 1.5};
        const double distance = bvh.signed_distance(p);
        if (std::abs(distance) < 2 * c.model.promise.tolerance) continue;
        EXPECT_EQ(field.value(p) > 0, distance > 0);
    }
    const Model moved = transformed(c.model, Affine{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, {5, 0, 0}});
    EXPECT_EQ(encode(*decode(encode(moved | c.model))), encode(moved | c.model));
}

TEST(MirroredModel, APlaneThatIsAskewIsTurned) {
    Random random(3);
    const Similarity place = shapes::random_place(random, 3);
    const TriangleMesh turned = shapes::placed(panel(), place);
    const Compressed c = compressed(turned), straight = compressed(panel());
    ASSERT_TRUE(part_of(c).mirror);
    EXPECT_EQ(c.model.objects[0].placements.list.size(), 1U);
    EXPECT_LE(c.bytes.size(), straight.bytes.size() + 40);
    EXPECT_TRUE(c.model.promise.certified);
    const Deviation d = measure_deviation(turned, to_mesh(*decode(c.bytes)), {.samples = 50'000});
    EXPECT_LE(d.max(), c.model.promise.tolerance);
}

TEST(MirroredModel, CopiesOfASymmetricPartHold) {
    Random random(6);
    TriangleMesh scene;
    for (int i = 0; i < 2; ++i) {
        Similarity place = shapes::random_place(random, 3);
        place.scale = 1;
        place.translation = {4.0 * i, 0, 0};
        shapes::append(scene, shapes::placed(casting(), place));
    }
    const Compressed c = compressed(scene, 1e-3);
    ASSERT_EQ(c.model.objects.size(), 1U);
    EXPECT_EQ(c.model.objects[0].placements.list.size(), 2U);
    EXPECT_TRUE(c.model.promise.certified);
    const Deviation d = measure_deviation(scene, to_mesh(*decode(c.bytes)), {.samples = 50'000});
    EXPECT_LE(d.max(), c.model.promise.tolerance);
}

TEST(MirroredModel, MaterialsNeedNotBeSymmetric) {
    PaintedMesh painted{casting(), {}};
    painted.materials.names = {"left", "right"};
    for (const Triangle& t : painted.mesh.faces) {
        const double x = painted.mesh.vertices[static_cast<std::size_t>(t[0])].x +
                         painted.mesh.vertices[static_cast<std::size_t>(t[1])].x +
                         painted.mesh.vertices[static_cast<std::size_t>(t[2])].x;
        painted.materials.of_face.push_back(x > 0.9 ? 1 : 0);
    }
    const Compressed c = compress(painted, {.tolerance = 2e-3});
    ASSERT_TRUE(part_of(c).mirror);
    EXPECT_GT(c.report.paint.right, 0.995);
}

}  // namespace
}  // namespace pfgeom
