#include "pfgeom/render/render.h"

#include "brute_force.h"
#include "codec/random_model.h"
#include "pfgeom/base/error.h"
#include "pfgeom/eval/solid_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace pfgeom {
namespace {

Task with_threads(int threads) {
    Task task;
    task.threads = threads;
    return task;
}

Picture draw(const Model& model, const View& view, const PictureSize& size, const Task& task = {}) {
    const RayScene scene(model, task);
    return render(scene, fit_camera(scene.cover(), view, size), size, task);
}

Model hierarchy() {
    Random random(7);
    Model model = test::ball();
    model.functions = {test::random_hierarchy(random, 5)};
    return model;
}

TEST(Render, SameBitsForAnyNumberOfThreads) {
    for (const Model& model : {hierarchy(), test::random_model(2), test::random_model(7)}) {
        const Picture one = draw(model, {}, {150, 90}, with_threads(1));
        for (const int threads : {2, 5}) {
            const Picture more = draw(model, {}, {150, 90}, with_threads(threads));
            EXPECT_EQ(one.depth, more.depth);
            EXPECT_EQ(one.normals, more.normals);
            EXPECT_EQ(one.objects, more.objects);
            EXPECT_EQ(one.functions, more.functions);
            EXPECT_EQ(one.colours, more.colours);
        }
    }
}

// A ball fills the picture but for the margin, in both kinds of camera; its depth is the ball's.
TEST(Render, BallFillsThePicture) {
    for (const double slope : {0.0, 0.25}) {
        const PictureSize size{200, 120};
        const Picture picture = draw(test::ball(), {{0, 0, -1}, {0, 1, 0}, slope, 0.05}, size);
        int left = 200, right = -1, top = 120, bottom = -1;
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 200; ++x) {
                if (picture.objects[static_cast<std::size_t>(y * 200 + x)] < 0) continue;
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = std::max(bottom, y);
            }
        }
        EXPECT_GE(top, 6);
        EXPECT_LE(top, 20);  // a perspective camera sees less than the middle section of the ball's box
        EXPECT_EQ(bottom, 119 - top);
        EXPECT_EQ(right, 199 - left);
        EXPECT_NEAR(right - left, bottom - top, 1);
    }
}

TEST(Render, DepthNormalsAndColoursAgree) {
    const Model model = hierarchy();
    const RayScene scene(model);
    const PictureSize size{64, 64};
    const Camera camera = fit_camera(scene.cover(), {}, size);
    const Picture picture = render(scene, camera, size);
    const SolidField field(model, std::get<Solid>(model.objects[0].shape));
    int seen = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto i = static_cast<std::size_t>(y * 64 + x);
            if (picture.objects[i] < 0) {
                EXPECT_EQ(picture.depth[i], Box::kInf);
                EXPECT_EQ(picture.colours[i][3], 0);
                continue;
            }
            ++seen;
            const Ray ray = camera.ray(2 * (x + 0.5) / 64 - 1, 1 - 2 * (y + 0.5) / 64);
            const Vec3 p = ray.at(picture.depth[i]);
            EXPECT_NEAR(dot(p - camera.eye, camera.forward), picture.depth[i], 1e-12);
            Vec3 gradient;
            const Vec3 local = model.objects[0].frame.to_local(p);
            EXPECT_LT(std::abs(field.value_and_gradient(local, gradient)), 1e-10);
            const auto& n = picture.normals[i];
            EXPECT_NEAR(norm(normalized(-gradient) - Vec3{n[0], n[1], n[2]}), 0, 1e-5);
            EXPECT_EQ(picture.colours[i][3], 255);
            EXPECT_GT(picture.colours[i][0], 40);
        }
    }
    EXPECT_GT(seen, 400);
}

// Tiles that are left out show nothing, from any side and also from within.
TEST(Render, EveryPixelIsItsRay) {
    Random random(5);
    for (const Model& model : {hierarchy(), test::random_model(2), test::random_model(9)}) {
        const RayScene scene(model);
        const std::vector<Box> cover = scene.cover();
        const PictureSize size{70, 50};
        for (int i = 0; i < 8; ++i) {
            Camera camera =
                fit_camera(cover, {test::any_point(random), {0, 0, 1}, i % 2 == 0 ? 0.4 : 0.0}, size);
            if (i > 3) camera.eye = cover[random.below(cover.size())].centre();
            std::vector<Ray> rays;
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x)
                    rays.push_back(
                        camera.ray(2 * (x + 0.5) / size.width - 1, 1 - 2 * (y + 0.5) / size.height));
            }
            const std::vector<SurfaceHit> hits = cast_rays(scene, rays, {}, {});
            const Picture picture = render(scene, camera, size);
            for (std::size_t k = 0; k < hits.size(); ++k) {
                EXPECT_EQ(picture.depth[k], hits[k].t);
                EXPECT_EQ(picture.functions[k], hits[k].function);
            }
        }
    }
}

TEST(Render, EverythingIsInThePicture) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        std::vector<Box> boxes;
        for (std::uint64_t k = 0; k <= random.below(4); ++k) {
            const Vec3 a = test::any_point(random, 3);
            boxes.push_back({a, a + Vec3{random.uniform(), random.uniform(), random.uniform()}});
        }
        const View view{test::any_point(random), test::any_point(random), i % 3 == 0 ? 0.0 : random.uniform(),
                        0.1};
        const Camera camera = fit_camera(boxes, view, {300, 200});
        double widest = 0;
        for (const Box& box : boxes) {
            for (unsigned k = 0; k < 8; ++k) {
                const Vec3 c{(k & 1U) != 0 ? box.hi.x : box.lo.x, (k & 2U) != 0 ? box.hi.y : box.lo.y,
                             (k & 4U) != 0 ? box.hi.z : box.lo.z};
                const double depth = dot(c - camera.eye, camera.forward);
                EXPECT_GT(depth, 0);
                const double scale = camera.orthographic ? 1 : depth;
                const double x = dot(c - camera.eye, camera.right) / squared_norm(camera.right) / scale;
                const double y = dot(c - camera.eye, camera.up) / squared_norm(camera.up) / scale;
                widest = std::max({widest, std::abs(x), std::abs(y)});
            }
        }
        EXPECT_LE(widest, 0.8 + 1e-9);
        EXPECT_GE(widest, 0.1);
    }
}

TEST(Render, SaysWhatIsWrong) {
    const RayScene scene(test::ball());
    const std::vector<Box> cover = scene.cover();
    EXPECT_THROW(fit_camera(cover, {.towards = {0, 0, 0}}, {}), InvalidInput);
    EXPECT_THROW(fit_camera(cover, {.towards = {0, 0, 2}}, {}), InvalidInput);  // along `up`
    EXPECT_THROW(fit_camera(cover, {.slope = -1}, {}), InvalidInput);
    EXPECT_THROW(fit_camera(cover, {.margin = 0.5}, {}), InvalidInput);
    EXPECT_THROW(fit_camera(cover, {}, {0, 10}), InvalidInput);
    EXPECT_THROW(fit_camera(cover, {}, {10, 8193}), InvalidInput);
    EXPECT_THROW(fit_camera(cover, {}, {10, 10, 0}), InvalidInput);
    EXPECT_THROW(fit_camera({}, {}, {}), InvalidInput);
    EXPECT_THROW(render(scene, fit_camera(cover, {}, {}), {10, -1}), InvalidInput);
    const auto found =
        cast_rays(scene, std::vector<Ray>{{{0, 0, Box::kInf}, {0, 0, 1}}, {{0, 0, 0}, {0, 0, 0}}}, {}, {});
    EXPECT_FALSE(found[0].found() || found[1].found());
}

TEST(Render, StopsWhenCancelled) {
    CancelToken cancel;
    Task task = with_threads(2);
    task.cancel = &cancel;
    const RayScene scene(hierarchy(), task);
    task.progress = [&](double, std::string_view) { cancel.cancel(); };
    const PictureSize size{512, 512};
    EXPECT_THROW(render(scene, fit_camera(scene.cover(), {}, size), size, task), Cancelled);
    EXPECT_THROW(RayScene(hierarchy(), task), Cancelled);
}

}  // namespace
}  // namespace pfgeom
