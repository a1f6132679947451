// Materials through the whole: mesh, file, mesh.
#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/mesh/mesh.h"
#include "placed_shapes.h"
#include "polygonize/mesh_checks.h"

#include <gtest/gtest.h>

#include <functional>

namespace pfgeom {
namespace {

using Label = std::function<std::int32_t(const Vec3& middle)>;

PaintedMesh painted(const TriangleMesh& mesh, int materials, const Label& label) {
    PaintedMesh result{mesh, {}};
    for (int m = 0; m < materials; ++m) result.materials.names.emplace_back(1, static_cast<char>('a' + m));
    for (const Triangle& f : mesh.faces)
        result.materials.of_face.push_back(
            label((mesh.vertices[f[0]] + mesh.vertices[f[1]] + mesh.vertices[f[2]]) / 3));
    return result;
}

Compressed compressed(const PaintedMesh& mesh, double tolerance = 1e-3, int threads = 0) {
    CompressOptions options;
    options.tolerance = tolerance;
    options.effort = Effort::fast;
    Task task;
    task.threads = threads;
    return compress(mesh, options, task);
}

// Measured by itself: samples of the rebuilt mesh against the nearest face of the input.
void expect_right(const PaintedMesh& input, const Compressed& c, double least = 0.995) {
    const Result<Model> model = decode(c.bytes);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->materials.names, input.materials.names);
    const PaintedMesh back = to_painted_mesh(*model);
    ASSERT_EQ(back.materials.of_face.size(), back.mesh.faces.size());
    const Bvh bvh(input.mesh);
    constexpr std::size_t kSamples = 20'000;
    const SurfaceSamples samples = sample_surface(back.mesh, kSamples, 77);
    std::size_t right = 0, stray = 0;
    std::vector<std::int32_t> near;
    for (std::size_t i = 0; i < kSamples; ++i) {
        const std::int32_t m = back.materials.of_face[static_cast<std::size_t>(samples.faces[i])];
        const ClosestPoint at = bvh.closest(samples.points[i]);
        if (input.materials.of_face[static_cast<std::size_t>(at.face)] == m) {
            ++right;
            continue;
        }
        near.clear();  // within the tolerance of a face that has it
        bvh.faces_within(at.point, model->promise.tolerance * 1.05, near);
        stray += std::any_of(near.begin(), near.end(),
                             [&](std::int32_t f) {
                                 return input.materials.of_face[static_cast<std::size_t>(f)] == m;
                             })
                     ? 0
                     : 1;
    }
    EXPECT_GE(static_cast<double>(right), least * kSamples);
    EXPECT_LE(stray, kSamples / 2000);
    EXPECT_NEAR(c.report.paint.right, static_cast<double>(right) / kSamples, 2e-3);
}

TEST(Paint, SidesOfACubeAreCreases) {
    const PaintedMesh cube =
        painted(shapes::divided(shapes::divided(shapes::divided(shapes::cube()))), 6, [](const Vec3& p) {
            return p.x > 0.999    ? 0
                   : p.x < -0.999 ? 1
                   : p.y > 0.999  ? 2
                   : p.y < -0.999 ? 3
                   : p.z > 0.999  ? 4
                                  : 5;
        });
    const Compressed c = compressed(cube);
    expect_right(cube, c);
    EXPECT_LE(c.report.paint.bytes, 45U);  // 12 of them the names
    EXPECT_TRUE(test::is_closed_manifold(to_painted_mesh(c.model).mesh));
}

TEST(Paint, ABlobKeepsItsPatches) {
    const PaintedMesh blob = painted(shapes::bumpy_sphere(4), 4, [](const Vec3& p) {
        return (p.x + 0.3 * p.y > 0.1 ? 1 : 0) + (p.z > 0.35 ? 2 : 0);
    });
    const Compressed c = compressed(blob, 4e-3);
    expect_right(blob, c, 0.99);
    EXPECT_TRUE(test::is_closed_manifold(to_painted_mesh(c.model).mesh));
    MeshOptions coarse;
    coarse.resolution = 24;  // at any resolution
    const PaintedMesh rough = to_painted_mesh(c.model, coarse);
    EXPECT_EQ(rough.materials.of_face.size(), rough.mesh.faces.size());
}

// Materials keep all faces of the default mesh, which may then have longer chords.
std::vector<Object> but_for_chords(std::vector<Object> objects) {
    for (Object& object : objects) object.mesh_code = 0;
    return objects;
}

TEST(Paint, FunctionsDoNotChangeAndPlainMeshesPayNothing) {
    const TriangleMesh mesh = shapes::torus(1, 0.4, 24, 12);
    CompressOptions options;
    options.effort = Effort::fast;
    options.tolerance = 1e-2;
    const Compressed plain = compress(mesh, options);
    const PaintedMesh one = painted(mesh, 1, [](const Vec3&) { return 0; });
    PaintedMesh unnamed = one;
    unnamed.materials.names = {""};
    EXPECT_EQ(compress(unnamed, options).bytes, plain.bytes);
    const Compressed two = compress(painted(mesh, 2, [](const Vec3& p) { return p.x > 0 ? 1 : 0; }), options);
    EXPECT_EQ(two.model.functions, plain.model.functions);
    EXPECT_EQ(but_for_chords(two.model.objects), but_for_chords(plain.model.objects));
    Model as_plain = plain.model;  // but for the default mesh
    as_plain.objects = two.model.objects;
    as_plain.promise = two.model.promise;
    EXPECT_EQ(two.bytes.size(), encode(as_plain).size() + two.report.paint.bytes);
    const Compressed named = compress(one, options);
    EXPECT_EQ(named.model.materials.names, one.materials.names);
    EXPECT_LE(named.report.paint.bytes, 12U);
}

TEST(Paint, CopiesMayDiffer) {
    const TriangleMesh part = shapes::cylinder(48);
    TriangleMesh scene;
    Random random(3);
    for (int i = 0; i < 8; ++i) {
        Similarity s = shapes::random_place(random, 0.3, i % 3 == 0);
        s.translation += Vec3{5.0 * i, 0, 0};
        append(shapes::placed(part, s), scene);
    }
    const auto number = [](const Vec3& p) { return static_cast<std::int32_t>((p.x + 2.5) / 5); };
    const PaintedMesh each = painted(scene, 8, number);
    const Compressed c = compressed(each);
    ASSERT_EQ(c.model.objects.size(), 1U);
    EXPECT_EQ(c.model.materials.objects[0].size(), 8U);
    expect_right(each, c, 1);
    const PaintedMesh alike = painted(scene, 8, [](const Vec3&) { return 3; });
    EXPECT_EQ(compressed(alike).model.materials.objects[0].size(), 1U);
}

TEST(Paint, CopiesThatAreAlikeShareTheirBorders) {
    const TriangleMesh part = shapes::divided(shapes::divided(shapes::divided(shapes::cube())));
    PaintedMesh scene;
    scene.materials.names = {"top", "rest"};
    for (int i = 0; i < 5; ++i) {
        const PaintedMesh one = painted(part, 2, [](const Vec3& p) { return p.z > 0.999 ? 0 : 1; });
        append(shapes::translated(one.mesh, {4.0 * i, 3.0 * (i % 2), 0}), scene.mesh);
        scene.materials.of_face.insert(scene.materials.of_face.end(), one.materials.of_face.begin(),
                                       one.materials.of_face.end());
    }
    const Compressed c = compressed(scene);
    expect_right(scene, c);
    for (const auto& paints : c.model.materials.objects) EXPECT_EQ(paints.size(), 1U);
}

// Of faces that coincide there is one, the first.
TEST(Paint, WhatTouchesKeepsItsOwn) {
    TriangleMesh two = shapes::divided(shapes::divided(shapes::cube()));
    append(shapes::translated(two, {2, 0, 0}), two);
    PaintedMesh mesh = painted(two, 2, [](const Vec3&) { return 0; });
    for (std::size_t f = mesh.materials.of_face.size() / 2; f < mesh.materials.of_face.size(); ++f)
        mesh.materials.of_face[f] = 1;
    const Compressed c = compressed(mesh);
    const PaintedMesh back = to_painted_mesh(c.model);
    double area[2] = {0, 0};
    for (std::size_t f = 0; f < back.mesh.faces.size(); ++f) {
        TriangleMesh one{back.mesh.vertices, {back.mesh.faces[f]}};
        area[back.materials.of_face[f]] += surface_area(one);
    }
    EXPECT_NEAR(area[0], 24, 0.1);
    EXPECT_NEAR(area[1], 20, 0.1);
}

TEST(Paint, OpenAndNonManifoldMeshesKeepTheirs) {
    const PaintedMesh saddle =
        painted(shapes::saddle(16), 2, [](const Vec3& p) { return p.x > p.y ? 1 : 0; });
    expect_right(saddle, compressed(saddle), 0.99);
    TriangleMesh fan = shapes::edge_fan(5);
    const PaintedMesh blades =
        painted(shapes::divided(shapes::divided(fan)), 2, [](const Vec3& p) { return p.z > 0.1 ? 1 : 0; });
    expect_right(blades, compressed(blades), 0.97);
}

TEST(Paint, DoesNotDependOnThreads) {
    const PaintedMesh blob = painted(shapes::bumpy_sphere(3), 3, [](const Vec3& p) {
        return p.x > 0.2 ? 1 : p.z > 0 ? 2 : 0;
    });
    EXPECT_EQ(compressed(blob, 5e-3, 1).bytes, compressed(blob, 5e-3, 3).bytes);
}

TEST(Paint, BadMaterialsAreNamed) {
    const PaintedMesh good = painted(shapes::cube(), 2, [](const Vec3& p) { return p.x > 0 ? 1 : 0; });
    const auto complaint = [&](const std::function<void(FaceMaterials&)>& change) {
        PaintedMesh bad = good;
        change(bad.materials);
        try {
            compress(bad, {});
        } catch (const InvalidInput& why) {
            return std::string(why.what());
        }
        return std::string();
    };
    EXPECT_EQ(complaint([](FaceMaterials& m) { m.of_face[5] = 2; }),
              "face 5 has material 2, there are 2 (rows from 0)");
    EXPECT_EQ(complaint([](FaceMaterials& m) { m.of_face.pop_back(); }),
              "there are 11 materials for 12 faces");
    EXPECT_EQ(complaint([](FaceMaterials& m) { m.names[1] = "\xFF"; }),
              "the name of material 1 is not UTF-8");
    EXPECT_EQ(complaint([](FaceMaterials& m) { m.names.resize(5000); }),
              "there are more than 4096 materials");
}

TEST(Paint, StopsWhenCancelled) {
    const PaintedMesh blob =
        painted(shapes::bumpy_sphere(4), 3, [](const Vec3& p) { return p.x > 0.2 ? 1 : 0; });
    CancelToken token;
    Task task;
    task.cancel = &token;
    task.progress = [&](double, std::string_view stage) {
        if (stage == "materials") token.cancel();
    };
    EXPECT_THROW(compress(blob, {.tolerance = 5e-3, .effort = Effort::fast}, task), Cancelled);
}

}  // namespace
}  // namespace pfgeom
