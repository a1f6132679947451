// Options, budgets, cancelling, threads.
#include "pfgeom/polygonize/polygonize.h"

#include "cancel.h"
#include "fields.h"
#include "mesh_checks.h"
#include "pfgeom/base/error.h"

namespace pfgeom::test {
namespace {

TEST(Polygonize, SameMeshForAnyNumberOfThreads) {
    const BumpField field(3, 60, 0.2, 0.5, 0.02);
    TriangleMesh first;
    for (const int threads : {1, 2, 5}) {
        Task task;
        task.threads = threads;
        const TriangleMesh mesh =
            polygonize(field, {.tolerance = 1e-3, .min_depth = 3, .max_depth = 8}, task);
        if (first.faces.empty()) first = mesh;
        EXPECT_FALSE(mesh.faces.empty());
        EXPECT_EQ(mesh.vertices, first.vertices);
        EXPECT_EQ(mesh.faces, first.faces);
    }
}

TEST(Polygonize, Budgets) {
    const FormulaField field = sphere_field(0.8);
    EXPECT_THROW(polygonize(field, {.tolerance = 1e-4, .max_cells = 5000}), LimitExceeded);
    EXPECT_THROW(polygonize(field, {.tolerance = 1e-4, .max_faces = 5000}), LimitExceeded);
    EXPECT_NO_THROW(polygonize(field, {.tolerance = 1e-2, .max_cells = 50'000, .max_faces = 20'000}));
}

TEST(Polygonize, RefusesWrongOptions) {
    const FormulaField field = sphere_field(0.8);
    EXPECT_THROW(polygonize(field, {.tolerance = 0}), InvalidInput);
    EXPECT_THROW(polygonize(field, {.tolerance = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
    EXPECT_THROW(polygonize(field, {.min_depth = 5, .max_depth = 4}), InvalidInput);
    EXPECT_THROW(polygonize(field, {.min_depth = -1}), InvalidInput);
    EXPECT_THROW(polygonize(field, {.max_depth = 21}), InvalidInput);
}

TEST(Polygonize, ProgressNeverFallsAndEndsAtOne) {
    double last = 0;
    Task task;
    task.progress = [&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    polygonize(sphere_field(0.8), {.tolerance = 1e-3}, task);
    EXPECT_EQ(last, 1);
}

TEST(Polygonize, CancelsSoon) {
    const BumpField field(3, 60, 0.2, 0.5, 0.02);
    for (const int milliseconds : {0, 20, 80, 200}) {
        expect_cancels_soon(milliseconds, [&](const Task& task) {
            polygonize(field, {.tolerance = 1e-7, .min_depth = 3, .max_depth = 12}, task);
        });
    }
}

}  // namespace
}  // namespace pfgeom::test
