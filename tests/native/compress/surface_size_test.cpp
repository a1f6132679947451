#include "pfgeom/compress/surface_size.h"

#include "codec/random_model.h"
#include "pfgeom/base/error.h"
#include "pfgeom/compress/compress.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfgeom {
namespace {

constexpr double kPi = std::numbers::pi;

// A ball of radius 1/√2 in place, a mirrored one of twice the size, and a cavity of half the size in each.
TEST(SurfaceSize, CopiesAndCavities) {
    Model model = test::ball();
    model.diagonal = 2;
    Similarity twice;
    twice.scale = 2;
    twice.rows[0] = {-1, 0, 0};
    twice.translation = {0.5, 0, 0};  // they overlap: each counts for itself
    model.objects[0].instances = {twice};
    model.objects.push_back(model.objects[0]);
    model.objects[1].frame.scale_code -= 8;
    model.objects[1].cavity_of = 0;
    const SurfaceSize size = surface_size(model, 1e-4);
    const double r = std::sqrt(0.5), area = 4 * kPi * r * r, volume = 4.0 / 3 * kPi * r * r * r;
    EXPECT_NEAR(size.area, area * (1 + 4) * 1.25, 1e-3 * area * 6);
    EXPECT_NEAR(size.volume, volume * (1 + 8) * (1 - 0.125), 1e-4 * size.area);
}

// A box with exact sides, also inside out; without a face it encloses nothing.
TEST(SurfaceSize, MeshParts) {
    TriangleMesh box = shapes::scaled(shapes::cube(), {0.5, 1, 1.5});
    for (const bool turned : {false, true}) {
        if (turned) {
            for (Triangle& t : box.faces) std::swap(t[1], t[2]);
        }
        const Model model = compress(box, {.tolerance = 1e-4}).model;
        const SurfaceSize size = surface_size(model, 1e-3);
        EXPECT_NEAR(size.volume, 6, 6e-3);
        EXPECT_NEAR(size.area, 22, 2e-2);
    }
    box.faces.pop_back();
    const SurfaceSize open = surface_size(compress(box, {.tolerance = 1e-4}).model, 1e-3);
    EXPECT_EQ(open.volume, 0);
    EXPECT_GT(open.area, 18);
}

TEST(SurfaceSize, ToleranceMustBePositive) {
    EXPECT_THROW(surface_size(test::ball(), 0), InvalidInput);
    EXPECT_THROW(surface_size(test::ball(), std::nan("")), InvalidInput);
}

}  // namespace
}  // namespace pfgeom
