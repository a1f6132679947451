#include "pfgeom/fit/thin.h"

#include "fit/sampled_distance.h"
#include "pfgeom/base/error.h"
#include "polygonize/mesh_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfgeom {
namespace {

TEST(Thin, ClosedSurfacesStayClosedAndVerticesWhereTheyAre) {
    for (const TriangleMesh& mesh : {shapes::sphere(4), shapes::torus(1, 0.4, 96, 48), shapes::cylinder(96),
                                     shapes::bumpy_sphere(4), shapes::casting()}) {
        SCOPED_TRACE(mesh.faces.size());
        const double distance = 4e-3 * diagonal(mesh);
        const TriangleMesh thin = thinned(mesh, distance);
        EXPECT_LT(thin.faces.size(), mesh.faces.size() / 2);
        EXPECT_LT(test::two_sided(mesh, thin), 1.02 * distance);
        EXPECT_TRUE(test::is_closed_manifold(thin));
        EXPECT_EQ(test::euler_characteristic(thin), test::euler_characteristic(mesh));
        for (const Vec3& v : thin.vertices) EXPECT_EQ(std::ranges::count(mesh.vertices, v), 1);
    }
}

TEST(Thin, NothingIsLostWhereEverythingIsNear) {
    const TriangleMesh mesh = shapes::torus();
    const TriangleMesh thin = thinned(mesh, 10 * diagonal(mesh));
    EXPECT_TRUE(test::is_closed_manifold(thin));
    EXPECT_EQ(test::euler_characteristic(thin), 0);
}

TEST(Thin, DoesNotDependOnThreads) {
    const TriangleMesh mesh = shapes::bumpy_sphere(4);
    Task one, four;
    one.threads = 1;
    four.threads = 4;
    const double distance = 2e-3 * diagonal(mesh);
    EXPECT_EQ(thinned(mesh, distance, one).vertices, thinned(mesh, distance, four).vertices);
}

TEST(Thin, StopsWhenCancelled) {
    const TriangleMesh mesh = shapes::bumpy_sphere(4);
    CancelToken token;
    token.cancel();
    Task task;
    task.cancel = &token;
    EXPECT_THROW(thinned(mesh, 1e-3, task), Cancelled);
}

}  // namespace
}  // namespace pfgeom
