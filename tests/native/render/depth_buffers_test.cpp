#include "pfgeom/render/depth_buffers.h"

#include "codec/random_model.h"
#include "pfgeom/base/error.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

DepthComparison compare(const RayScene& a, const RayScene& b, double tolerance = 1e-3, int side = 200) {
    return compare_depths(a, b, {side, tolerance});
}

// A square of side 2 across z, of n by n cells, without those for which `left_out(row, column)` holds.
template <class LeftOut>
TriangleMesh square(int n, LeftOut left_out) {
    TriangleMesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) mesh.vertices.push_back({2.0 * i / n - 1, 2.0 * j / n - 1, 0});
    const std::vector<Triangle> faces = shapes::grid_faces(n + 1, n + 1, false, false);
    for (std::size_t k = 0; k < faces.size(); ++k) {
        const int cell = static_cast<int>(k / 2);
        if (!left_out(cell / n, cell % n)) mesh.faces.push_back(faces[k]);
    }
    return mesh;
}

TriangleMesh whole_square(int n) {
    return square(n, [](int, int) { return false; });
}

const DepthView& along(const DepthComparison& comparison, const Vec3& direction) {
    for (const DepthView& view : comparison.views)
        if (view.direction == direction) return view;
    throw std::logic_error("no such view");
}

TEST(DepthBuffers, EqualShapesLookEqualFromFourteenSides) {
    const RayScene scene(shapes::bumpy_sphere());
    const DepthComparison found = compare(scene, scene);
    ASSERT_EQ(found.views.size(), 14U);
    for (std::size_t i = 0; i < found.views.size(); ++i) {
        const auto& [direction, pixel, figures] = found.views[i];
        EXPECT_NEAR(norm(direction), 1, 1e-15);
        EXPECT_GT(figures.both, 200 * 200 / 4);
        EXPECT_EQ(figures.sum, 0);
        EXPECT_EQ(figures.silhouette(), 0);
        for (std::size_t j = 0; j < i; ++j) EXPECT_LT(dot(direction, found.views[j].direction), 0.9);
    }
    EXPECT_GT(found.total.away, found.total.both / 2);
}

// A step of the whole upper side is what the view from above sees, everywhere; from below there is none.
TEST(DepthBuffers, RaisedSideIsMeasured) {
    TriangleMesh raised = shapes::cube();
    for (Vec3& v : raised.vertices) v.z = v.z > 0 ? 1.0625 : v.z;
    const DepthComparison found = compare(RayScene(shapes::cube()), RayScene(raised), 0.0625 / 3 - 1e-9);
    const DepthFigures& above = along(found, {0, 0, -1}).figures;
    EXPECT_NEAR(above.mean(), 0.0625, 1e-12);
    EXPECT_NEAR(above.max, 0.0625, 1e-12);
    EXPECT_EQ(above.differing, above.both);
    EXPECT_EQ(above.differing_away, above.away);
    EXPECT_EQ(above.silhouette(), 0);
    const DepthFigures& below = along(found, {0, 0, 1}).figures;
    EXPECT_LT(below.max, 1e-12);
    const DepthFigures& aside = along(found, {1, 0, 0}).figures;
    EXPECT_EQ(aside.only_a, 0);
    EXPECT_GT(aside.only_b, 0);
    EXPECT_LT(aside.max, 1e-12);
}

// A block on one side of a cube stands out where it is, by as much as it does.
TEST(DepthBuffers, BumpIsSeen) {
    const TriangleMesh bump = shapes::joined(shapes::cube(), shapes::cube(0.25, {0.3, -0.2, 0.8125}));
    const DepthView view = along(compare(RayScene(shapes::cube()), RayScene(bump), 0.01), {0, 0, -1});
    const double area = 0.5 * 0.5 / (view.pixel * view.pixel);
    EXPECT_NEAR(static_cast<double>(view.figures.differing), area, 0.1 * area);
    // None of it is near a discontinuity of the first: the border of the bump is the second's alone.
    EXPECT_EQ(view.figures.differing_away, view.figures.differing);
    EXPECT_NEAR(view.figures.max, 0.0625, 1e-12);
}

// Every pixel of a slit so narrow that all of it is at the border counts as well.
TEST(DepthBuffers, HolesAndSlitsAreSeen) {
    const RayScene whole(whole_square(20));
    const auto look = [&](const TriangleMesh& mesh) {
        return along(compare(whole, RayScene(mesh)), {0, 0, -1});
    };
    const DepthView hole = look(square(20, [](int i, int j) { return i >= 5 && i < 9 && j >= 7 && j < 11; }));
    const double area = 0.4 * 0.4 / (hole.pixel * hole.pixel);
    EXPECT_NEAR(static_cast<double>(hole.figures.only_a), area, 0.1 * area);
    EXPECT_EQ(hole.figures.silhouette_away, hole.figures.only_a);
    EXPECT_EQ(hole.figures.only_b, 0);
    const DepthView slit = look(square(100, [](int i, int j) { return i == 50 && j >= 10 && j < 90; }));
    EXPECT_GT(slit.figures.only_a, 2 * 60);
    EXPECT_EQ(slit.figures.silhouette_away, slit.figures.only_a);
}

// At an outline that moves by less than a pixel nothing is away.
TEST(DepthBuffers, MovedOutlineIsNearDiscontinuities) {
    const double by = 0.01;
    const RayScene a(shapes::cube());
    const DepthFigures total =
        compare(a, RayScene(shapes::translated(shapes::cube(), {by, by, by})), by).total;
    EXPECT_GT(total.only_a, 100);
    EXPECT_GT(total.only_b, 100);
    EXPECT_EQ(total.silhouette_away, 0);
    EXPECT_LE(total.away_max, 3 * by);
}

// A model is drawn from its function: the depth of a ball is exact, and so a mesh's own error shows.
TEST(DepthBuffers, ModelsAreDrawnFromTheirFunctions) {
    const RayScene ball(test::ball());
    const double radius = 1 / std::sqrt(2.0);
    double before = 1;
    for (const int levels : {3, 4, 5}) {
        const DepthFigures total = compare(ball, RayScene(shapes::sphere(levels, radius))).total;
        EXPECT_EQ(total.only_b, 0);  // the mesh lies within
        EXPECT_GT(total.away_mean(), 0);
        EXPECT_LT(total.away_mean(), 0.35 * before);  // the error of chords falls to a quarter
        before = total.away_mean();
    }
    EXPECT_EQ(compare(ball, RayScene(shapes::sphere(5, radius))).total.silhouette_away, 0);
}

TEST(DepthBuffers, SameFiguresForAnyNumberOfThreads) {
    const RayScene a(shapes::bumpy_sphere(4, 0.3)), b(shapes::bumpy_sphere(3, 0.3));
    const auto figures = [&](int threads) {
        Task task;
        task.threads = threads;
        return compare_depths(a, b, {90, 1e-3}, task).total;
    };
    const DepthFigures one = figures(1);
    EXPECT_GT(one.differing, 0);
    for (const int threads : {2, 5}) {
        const DepthFigures more = figures(threads);
        EXPECT_EQ(one.sum, more.sum);
        EXPECT_EQ(one.away_sum, more.away_sum);
        EXPECT_EQ(one.max, more.max);
        EXPECT_EQ(one.both, more.both);
        EXPECT_EQ(one.differing, more.differing);
        EXPECT_EQ(one.silhouette(), more.silhouette());
        EXPECT_EQ(one.silhouette_away, more.silhouette_away);
    }
}

TEST(DepthBuffers, ProgressRisesAndCancelStops) {
    const RayScene scene(shapes::sphere());
    CancelToken cancel;
    double last = 0;
    int calls = 0;
    const Task task{1, &cancel, [&](double fraction, std::string_view) {
                        EXPECT_GE(fraction, last);
                        last = fraction;
                        if (++calls == 5) cancel.cancel();
                    }};
    EXPECT_THROW(compare_depths(scene, scene, {100, 1e-3}, task), Cancelled);
    EXPECT_EQ(calls, 5);
}

TEST(DepthBuffers, NothingAgainstSomething) {
    const RayScene nothing{TriangleMesh{}}, ball(test::ball());
    const DepthFigures total = compare(ball, nothing).total;
    EXPECT_EQ(total.both, 0);
    EXPECT_EQ(total.mean(), 0);
    EXPECT_EQ(total.silhouette_away, total.only_a);
    EXPECT_THROW(compare(nothing, nothing), InvalidInput);
    EXPECT_THROW(compare_depths(ball, ball, {0, 1e-3}), InvalidInput);
    EXPECT_THROW(compare_depths(ball, ball, {64, 0}), InvalidInput);
}

}  // namespace
}  // namespace pfgeom
