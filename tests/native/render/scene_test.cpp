#include "pfgeom/render/scene.h"

#include "brute_force.h"
#include "codec/random_model.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/mesh/bvh.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

Similarity moved(const Vec3& by, double scale = 1) {
    Similarity s;
    s.translation = by;
    s.scale = scale;
    return s;
}

// A ball of radius 1/√2 and copies of it.
Model balls(std::vector<Similarity> copies) {
    Model model = test::ball();
    model.objects[0].instances = std::move(copies);
    return model;
}

TEST(RayScene, NearestOfManyCopies) {
    Random random(4);
    std::vector<Similarity> copies;
    for (int i = 0; i < 60; ++i) {
        copies.push_back(test::random_similarity(random));
        copies.back().scale = 0.2 + random.uniform();
    }
    const RayScene scene(balls(copies));
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray = test::random_ray(random, {{-9, -9, -9}, {9, 9, 9}});
        double nearest = Box::kInf;
        copies.emplace_back();  // the one in place
        for (const Similarity& s : copies) {
            const double r = s.scale * std::sqrt(0.5), b = dot(ray.direction, s.translation - ray.origin);
            const double c = b * b - squared_norm(s.translation - ray.origin) + r * r;
            if (c < 0) continue;
            for (const double t : {b - std::sqrt(c), b + std::sqrt(c)}) {
                if (t >= 0) nearest = std::min(nearest, t);
            }
        }
        copies.pop_back();
        const SurfaceHit hit = scene.first_hit(ray);
        ASSERT_EQ(hit.found(), nearest < Box::kInf) << i;
        if (!hit.found()) continue;
        EXPECT_NEAR(hit.t, nearest, 1e-9);
        EXPECT_EQ(hit.object, 0);
        ++hits;
    }
    EXPECT_GT(hits, 300);
}

// The normal of a hollow points into it, that of a mirrored copy outwards.
TEST(RayScene, NormalsPointOutwards) {
    Model model = test::ball();
    model.objects.push_back(model.objects[0]);
    model.objects[1].frame.scale_code = -8;
    model.objects[1].cavity_of = 0;
    const RayScene scene(model);
    const SurfaceHit outer = scene.first_hit({{-3, 0, 0}, {1, 0, 0}});
    EXPECT_EQ(outer.object, 0);
    EXPECT_NEAR(outer.normal.x, -1, 1e-12);
    const SurfaceHit inner = scene.first_hit({{0, 0, 0}, {1, 0, 0}});
    EXPECT_EQ(inner.object, 1);
    EXPECT_NEAR(inner.t, std::sqrt(0.125), 1e-12);
    EXPECT_NEAR(inner.normal.x, -1, 1e-12);

    Similarity mirrored = moved({5, 0, 0}, 2);
    mirrored.rows[0] = {-1, 0, 0};
    const SurfaceHit copy = RayScene(balls({mirrored})).first_hit({{9, 0, 0}, {-1, 0, 0}});
    EXPECT_NEAR(copy.t, 4 - std::sqrt(2), 1e-12);
    EXPECT_NEAR(copy.normal.x, 1, 1e-12);
}

TEST(RayScene, MeshPartsAreTheirTriangles) {
    Random random(6);
    for (int i = 0; i < 6; ++i) {
        Model model;
        model.diagonal = 2000;
        Object object;
        object.frame = test::random_frame(random);
        MeshPart part = test::random_mesh_part(random);
        if (i % 2 == 1) part = test::with_random_bulges(part, random);
        object.shape = part;
        model.objects = {object};
        const RayScene scene(model);
        const TriangleMesh mesh = mesh_of(object, {.chord = 1e-5 * model.diagonal});
        const Bvh bvh(mesh);
        for (int k = 0; k < (i % 2 == 0 ? 300 : 10); ++k) {  // curved ones are a tangle of 10⁵ triangles
            const Ray ray = test::random_ray(random, bvh.bounds());
            const RayHit expected = bvh.first_hit(ray.origin, ray.direction);
            const SurfaceHit hit = scene.first_hit(ray);
            EXPECT_EQ(hit.function, expected.face);
            EXPECT_EQ(hit.t, expected.face < 0 ? Box::kInf : expected.t);
        }
    }
}

// Whatever a file may hold: no crash, no endless search, hits that are numbers.
TEST(RayScene, AnyModel) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const RayScene scene(test::random_model(seed));
        Random random(seed);
        Box box;
        for (const Box& part : scene.cover()) box.grow(part);
        if (box.empty()) continue;
        for (int i = 0; i < 100; ++i) {
            const Ray ray = test::random_ray(random, box);
            const SurfaceHit hit = scene.first_hit(ray);
            if (!hit.found()) continue;
            EXPECT_TRUE(std::isfinite(hit.t) && is_finite(hit.normal));
            EXPECT_TRUE(box.contains(ray.at(hit.t)) ||
                        box.squared_distance(ray.at(hit.t)) < 1e-12 * squared_norm(box.extent()));
        }
    }
}

}  // namespace
}  // namespace pfgeom
