#include "pfgeom/compress/compress.h"

#include "pfgeom/base/random.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/mesh/mesh.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

Compressed compressed(const TriangleMesh& mesh, double tolerance, Metric metric = Metric::max,
                      int threads = 0) {
    Task task;
    task.threads = threads;
    CompressOptions options;
    options.tolerance = tolerance;
    options.metric = metric;
    return compress(mesh, options, task);
}

struct Shape {
    const char* name;
    TriangleMesh mesh;
};

std::vector<Shape> any_shapes() {
    return {{"sphere", shapes::sphere(3)},
            {"torus", shapes::torus(1, 0.4, 48, 24)},
            {"bumpy", shapes::bumpy_sphere(3)},
            {"cube", shapes::cube()},
            {"open cone", shapes::open_cone()},
            {"moebius", shapes::moebius()},
            {"klein", shapes::klein_bottle()},
            {"fan", shapes::edge_fan()},
            {"slivers", shapes::sliver_fan()},
            {"soup", shapes::soup(shapes::torus())},
            {"inside out", shapes::flipped(shapes::sphere(3))},
            {"misoriented", shapes::misoriented_sphere()},
            {"cracked", shapes::cracked_cube()},
            {"shells", shapes::nested_shells()},
            {"scene", shapes::scene_of_islands(12, 2)}};
}

// The promise is checked from the bytes alone: a mesh that decoding gives, against the input.
void expect_promise(const Shape& shape, double tolerance, Metric metric) {
    SCOPED_TRACE(shape.name);
    const Compressed c = compressed(shape.mesh, tolerance, metric);
    const Result<Model> model = decode(c.bytes);
    ASSERT_TRUE(model);
    const Deviation d = measure_deviation(shape.mesh, to_mesh(*model));
    const double limit = tolerance * diagonal(shape.mesh);
    EXPECT_LE(metric == Metric::max ? d.max() : d.rms(), limit * (1 + 1e-9));
    EXPECT_LE(d.max(), model->promise.bound_mesh * (1 + 1e-6)) << "the stored bound is a bound";
    EXPECT_NEAR(model->promise.tolerance, limit, 1e-4 * limit);
}

TEST(Compress, HoldsItsPromiseForAnyShape) {
    for (const Shape& shape : any_shapes()) {
        expect_promise(shape, 1e-2, Metric::max);
    }
}

TEST(Compress, HoldsItsPromiseAtFineTolerances) {
    expect_promise({"cube", shapes::cube()}, 1e-5, Metric::max);
    expect_promise({"cracked", shapes::cracked_cube()}, 1e-3, Metric::max);
    expect_promise({"klein", shapes::klein_bottle(16, 8)}, 1e-3, Metric::max);
    expect_promise({"bumpy", shapes::bumpy_sphere(3)}, 5e-3, Metric::rms);
}

TEST(Compress, ASphereIsOneFunctionAndAFewBytes) {
    const Compressed c = compressed(shapes::sphere(4), 5e-3);
    const FunctionCount n = count_functions(c.model);
    EXPECT_EQ(n.surface, 1);
    EXPECT_EQ(n.perturbations, 0);
    EXPECT_EQ(n.mesh_part_faces, 0);
    EXPECT_LT(c.bytes.size(), 80U);
}

TEST(Compress, ABoxIsATreeHoweverFewItsFaces) {
    const Compressed c = compressed(shapes::cube(), 1e-2);
    EXPECT_EQ(c.report.islands.at(0).candidate, "tree");
    EXPECT_EQ(count_functions(c.model).mesh_part_faces, 0);
    EXPECT_LT(c.bytes.size(), 40U);
}

// The promise is about the mesh without chords that nobody needs; the functions' own is there to be asked
// for.
TEST(Compress, TheMeshOfATreeIsThin) {
    const TriangleMesh input = shapes::cylinder(256);
    const Compressed c = compressed(input, 5e-3);
    ASSERT_EQ(c.report.islands.at(0).candidate, "tree");
    const TriangleMesh thin = to_mesh(c.model), all = to_mesh(c.model, {.thin = false});
    EXPECT_LT(thin.faces.size(), all.faces.size() * 3 / 4);
    EXPECT_LE(measure_deviation(input, thin).max_bound(), c.model.promise.tolerance);
    const ModelField field(c.model);
    for (const Vec3& v : all.vertices) EXPECT_LT(std::abs(field.value(v)), 1e-9);
}

// A polyhedron in a ball: its quadrics serve several sides each, and their tree would be endless.
TEST(Compress, ABallOfFewFlatSidesIsAMesh) {
    const Compressed c = compressed(shapes::sphere(2), 1e-3);
    EXPECT_EQ(c.report.islands.at(0).candidate, "mesh");
}

TEST(Compress, SmoothFreeFormsBecomeAHierarchy) {
    const Compressed c = compressed(shapes::bumpy_sphere(4), 1e-3, Metric::rms);
    EXPECT_EQ(c.report.islands.at(0).candidate, "hierarchy");
    EXPECT_GT(count_functions(c.model).perturbations, 10);
    const TriangleMesh mesh = to_mesh(c.model);
    const PreparedMesh prepared = prepare_mesh(mesh, 0);
    ASSERT_EQ(prepared.islands.size(), 1U);
    EXPECT_TRUE(prepared.islands[0].closed && prepared.islands[0].manifold && prepared.islands[0].oriented);
}

// At every point that is further away than what is proved of the functions, they know inside from outside.
TEST(Compress, WhatIsProvedOfASetTreeIsTrueOfItsFunctions) {
    for (const bool inward : {false, true}) {
        const TriangleMesh input = inward ? shapes::flipped(shapes::cylinder(64)) : shapes::cylinder(64);
        const Compressed c = compressed(input, 5e-3);
        ASSERT_EQ(c.report.islands.at(0).candidate, "tree");
        const Promise& promise = c.model.promise;
        EXPECT_TRUE(promise.functions_certified);
        EXPECT_GT(promise.bound_functions, 0);
        EXPECT_LE(promise.bound_functions, promise.tolerance * (1 + 1e-12));
        const ModelField field(c.model);
        const Bvh bvh(input);
        Random random(5);
        int decided = 0;
        for (Vec3 p : sample_surface(input, 4000, 5).points) {
            for (int axis = 0; axis < 3; ++axis) {
                p[axis] += 3 * promise.bound_functions * (2 * random.uniform() - 1);
            }
            if (bvh.closest(p).squared_distance <= promise.bound_functions * promise.bound_functions)
                continue;
            ++decided;
            EXPECT_EQ(field.contains(p), std::abs(bvh.winding_number(p)) > 0.5);
        }
        EXPECT_GT(decided, 1000);
    }
}

// The worst of all islands, and nothing if one has no proof or if there are no functions.
TEST(Compress, WhatIsProvedOfTheFunctionsIsAboutAllIslands) {
    const auto promise = [](const TriangleMesh& mesh) { return compressed(mesh, 5e-3).model.promise; };
    const TriangleMesh tree = shapes::cylinder(64);
    const Promise mixed = promise(shapes::joined(tree, shapes::translated(shapes::open_cone(), {4, 0, 0})));
    EXPECT_TRUE(mixed.functions_certified);
    EXPECT_GT(mixed.bound_functions, 0);
    EXPECT_LE(mixed.bound_functions, mixed.tolerance * (1 + 1e-12));
    for (const Promise& all : {promise(shapes::joined(tree, shapes::translated(shapes::sphere(), {4, 0, 0}))),
                               promise(shapes::ellipsoid({1, 0.6, 0.3}, 4))}) {
        EXPECT_TRUE(all.functions_certified) << "single quadrics too";
        EXPECT_GT(all.bound_functions, 0);
        EXPECT_LE(all.bound_functions, all.tolerance * (1 + 1e-12));
    }
    EXPECT_EQ(promise(shapes::open_cone()).bound_functions, 0);
}

TEST(Compress, EveryEffortKeepsThePromise) {
    const TriangleMesh input = shapes::cylinder(64);
    CompressOptions options;
    options.tolerance = 5e-3;
    for (const Effort effort : {Effort::fast, Effort::normal, Effort::best}) {
        options.effort = effort;
        const Compressed c = compress(input, options);
        EXPECT_LE(measure_deviation(input, to_mesh(c.model)).max(), c.model.promise.bound_mesh * (1 + 1e-6));
        EXPECT_LE(c.model.promise.bound_mesh, c.model.promise.tolerance);
    }
}

TEST(Compress, BytesDoNotDependOnThreads) {
    for (const Shape& shape :
         {Shape{"bumpy", shapes::bumpy_sphere(3)}, Shape{"scene", shapes::scene_of_islands(12, 2)}}) {
        SCOPED_TRACE(shape.name);
        EXPECT_EQ(compressed(shape.mesh, 1e-2, Metric::max, 1).bytes,
                  compressed(shape.mesh, 1e-2, Metric::max, 2).bytes);
    }
}

TEST(Compress, CavitiesStayHollowAndOrientationStays) {
    const TriangleMesh input = shapes::nested_shells(3, 3);
    const Compressed c = compressed(input, 5e-3);
    const ModelField field(c.model);
    const PreparedMesh before = prepare_mesh(input, 0), after = prepare_mesh(to_mesh(c.model), 0);
    ASSERT_EQ(before.islands.size(), after.islands.size());
    double volume = 0, volume_after = 0;
    for (const Island& i : before.islands) volume += i.signed_volume;
    for (const Island& i : after.islands) volume_after += i.signed_volume;
    EXPECT_NEAR(volume_after, volume, 0.02 * std::abs(volume));
    const Bvh bvh(input);
    int decided = 0;
    for (const Vec3& p : sample_surface(shapes::sphere(2, 0.77 * bounds(input).hi.x), 200, 3).points) {
        if (bvh.closest(p).squared_distance < 1e-3) continue;
        ++decided;
        EXPECT_EQ(field.contains(p), bvh.winding_number(p) > 0.5);
    }
    EXPECT_GT(decided, 20);
}

TEST(Compress, RefusesBadOptionsAndMeshes) {
    const TriangleMesh cube = shapes::cube();
    EXPECT_THROW(compressed(cube, 0), InvalidInput);
    EXPECT_THROW(compressed(cube, -1), InvalidInput);
    EXPECT_THROW(compressed(cube, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
    EXPECT_THROW(compressed({}, 1e-3), InvalidInput);
    TriangleMesh bad = cube;
    bad.vertices[3].y = std::numeric_limits<double>::infinity();
    EXPECT_THROW(compressed(bad, 1e-3), InvalidInput);
}

TEST(Compress, CanBeCancelled) {
    CancelToken token;
    token.cancel();
    Task task;
    task.cancel = &token;
    EXPECT_THROW(compress(shapes::sphere(3), {}, task), Cancelled);
}

TEST(ToMesh, ResolutionAndToleranceSteerTheMesh) {
    const Compressed c = compressed(shapes::sphere(3), 1e-2);
    ASSERT_EQ(count_functions(c.model).surface, 1);
    const std::size_t coarse = to_mesh(c.model, {{}, 16}).faces.size(),
                      fine = to_mesh(c.model, {{}, 64}).faces.size();
    EXPECT_LT(4 * coarse, fine);
    EXPECT_LT(to_mesh(c.model, {1e-2, {}}).faces.size(), to_mesh(c.model, {1e-4, {}}).faces.size());
    EXPECT_THROW(to_mesh(c.model, {1e-2, 32}), InvalidInput);
    EXPECT_THROW(to_mesh(c.model, {{}, 4}), InvalidInput);
    EXPECT_THROW(to_mesh(c.model, {-1.0, {}}), InvalidInput);
}

}  // namespace
}  // namespace pfgeom
