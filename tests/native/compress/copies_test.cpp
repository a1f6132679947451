// Scenes in which shapes repeat.
#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/mesh/mesh.h"
#include "pfgeom/mesh/prepare.h"
#include "placed_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfgeom {
namespace {

using shapes::placed;

// Each in a cell of its own, turned at random, every third one mirrored.
TriangleMesh scene_of(const TriangleMesh& part, int n, std::uint64_t seed, const Vec3& at = {}) {
    Random random(seed);
    TriangleMesh scene;
    for (int i = 0; i < n; ++i) {
        Similarity s = shapes::random_place(random, 0.3, i % 3 == 0);
        s.translation += at + Vec3{5.0 * (i % 4), 5.0 * (i / 4 % 4), 5.0 * (i / 16)};
        append(placed(part, s), scene);
    }
    return scene;
}

Compressed compressed(const TriangleMesh& mesh, double tolerance, Metric metric = Metric::max,
                      int threads = 0) {
    CompressOptions options;
    options.tolerance = tolerance;
    options.relative = false;
    options.metric = metric;
    Task task;
    task.threads = threads;
    return compress(mesh, options, task);
}

void expect_promise(const TriangleMesh& input, const Compressed& c) {
    const Result<Model> model = decode(c.bytes);
    ASSERT_TRUE(model);
    const Deviation d = measure_deviation(input, to_mesh(*model));
    const bool by_max = model->promise.metric == Metric::max;
    EXPECT_LE(by_max ? d.max() : d.rms(), model->promise.tolerance * (1 + 1e-9));
    EXPECT_LE(d.max(), model->promise.bound_mesh * (1 + 1e-6));
}

std::size_t copies_in(const Model& model) {
    std::size_t copies = 0;
    for (const Object& object : model.objects) copies += copies_of(object).size();
    return copies;
}

TEST(CompressCopies, AreOneObjectAndAFewBytesEach) {
    for (const Metric metric : {Metric::max, Metric::rms}) {
        const TriangleMesh part = shapes::cylinder(48), scene = scene_of(part, 20, 1);
        const double tolerance = 0.01;
        const Compressed c = compressed(scene, tolerance, metric);
        expect_promise(scene, c);
        ASSERT_EQ(c.model.objects.size(), 1U);
        EXPECT_EQ(c.model.objects[0].placements.list.size(), 20U);
        EXPECT_EQ(c.report.islands.size(), 20U);
        EXPECT_EQ(c.report.islands[7].copies, 20);
        const Compressed one = compressed(part, tolerance, metric);
        EXPECT_EQ(count_functions(c.model).surface, count_functions(one.model).surface) << "counted once";
        EXPECT_LE(c.bytes.size(), one.bytes.size() + 20 * 11);
        if (metric == Metric::max) {
            EXPECT_TRUE(c.model.promise.certified);
            EXPECT_TRUE(c.model.promise.functions_certified);
            EXPECT_LE(c.model.promise.bound_functions, c.model.promise.tolerance * (1 + 1e-3));
        }
    }
}

TEST(CompressCopies, OfMeshPartsToo) {
    const TriangleMesh part = shapes::warped(shapes::open_cone(48)), scene = scene_of(part, 12, 2);
    const Compressed c = compressed(scene, 5e-3);
    expect_promise(scene, c);
    ASSERT_EQ(c.model.objects.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<MeshPart>(c.model.objects[0].shape));
    EXPECT_EQ(copies_in(c.model), 12U);
}

TEST(CompressCopies, AmongOtherThings) {
    TriangleMesh scene = scene_of(shapes::cylinder(48), 9, 3);
    append(scene_of(shapes::warped(shapes::torus(1, 0.4, 16, 8)), 7, 4, {0, 0, 20}), scene);
    append(shapes::translated(shapes::ellipsoid({2, 1, 0.5}), {-9, 0, 0}), scene);
    append(shapes::translated(shapes::soup(shapes::torus()), {-9, 9, 0}), scene);
    const Compressed c = compressed(scene, 0.02);
    expect_promise(scene, c);
    std::vector<std::size_t> counts;
    for (const Object& object : c.model.objects) counts.push_back(object.placements.list.size());
    std::sort(counts.begin(), counts.end());
    EXPECT_EQ(counts, (std::vector<std::size_t>{0, 0, 7, 9}));
    const TriangleMesh again = to_mesh(c.model);
    EXPECT_EQ(static_cast<std::int64_t>(again.faces.size()), c.report.mesh_faces);
}

// The faces of a mirrored copy point outwards too, and what it encloses is inside.
TEST(CompressCopies, FaceOutwards) {
    const TriangleMesh scene = scene_of(shapes::warped(shapes::torus(1, 0.4, 16, 8)), 9, 5);
    const Compressed c = compressed(scene, 0.02);
    const std::vector<Placement>& list = c.model.objects[0].placements.list;
    EXPECT_GT(std::count_if(list.begin(), list.end(), [](const Placement& one) { return one.mirrored; }), 0);
    for (const Island& island : prepare_mesh(to_mesh(c.model), 0).islands) EXPECT_GT(island.signed_volume, 0);
    const ModelField field(c.model);
    const Bvh bvh(scene);
    Random random(6);
    const Box box = field.bounds();
    int inside = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 p{box.lo.x + box.extent().x * random.uniform(),
                     box.lo.y + box.extent().y * random.uniform(),
                     box.lo.z + box.extent().z * random.uniform()};
        if (bvh.closest(p).squared_distance < 0.05 * 0.05) continue;
        EXPECT_EQ(field.contains(p), bvh.winding_number(p) > 0.5);
        inside += field.contains(p) ? 1 : 0;
    }
    EXPECT_GT(inside, 20);
}

// A pair of balls takes fewer bytes as two functions.
TEST(CompressCopies, OnlyWhereTheyPay) {
    TriangleMesh scene = shapes::sphere(3);
    append(shapes::translated(shapes::sphere(3), {5, 0, 0}), scene);
    const Compressed c = compressed(scene, 0.01);
    expect_promise(scene, c);
    EXPECT_EQ(c.model.objects.size(), 2U);
}

TEST(CompressCopies, BytesDoNotDependOnThreads) {
    const TriangleMesh scene = scene_of(shapes::cylinder(24), 20, 7);
    EXPECT_EQ(compressed(scene, 0.01, Metric::max, 1).bytes, compressed(scene, 0.01, Metric::max, 2).bytes);
}

TEST(ToMesh, CopiesBeyondTheLimitAreRefused) {
    Model model;
    model.diagonal = 2;
    model.functions.push_back({{{-1, -1, -1, 0, 0, 0, 0, 0, 0, 0.5}}, {}, {}, {}});
    Object object;
    object.shape = Solid{{{SetNode::Kind::function, 0, -1, -1}}};
    object.mesh_code = 40;
    object.placements.list.resize(200'000);
    model.objects = {object};
    EXPECT_THROW(to_mesh(model), LimitExceeded);
}

}  // namespace
}  // namespace pfgeom
