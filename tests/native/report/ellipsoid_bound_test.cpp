#include "pfgeom/report/ellipsoid_bound.h"

#include "pfgeom/report/deviation.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Above 0 inside: 1 - |x'|², where x' = (x + 0.4 y, y, z - 0.1) / (0.8, 0.3, 0.5).
Quadric leaning() {
    Quadric q;
    q.c = {-1 / 0.64, -0.16 / 0.64 - 1 / 0.09, -4, -0.8 / 0.64, 0, 0, 0, 0, 0.8, 1 - 0.04};
    return q;
}

TriangleMesh leaning_mesh(int level) {
    TriangleMesh mesh = shapes::sphere(level);
    for (Vec3& p : mesh.vertices) {
        const double y = 0.3 * p.y;
        p = {0.8 * p.x - 0.4 * y, y, 0.5 * p.z + 0.1};
    }
    return mesh;
}

std::optional<double> bound_of(const Quadric& quadric, const TriangleMesh& mesh) {
    return bound_ellipsoid(quadric, mesh, Bvh(mesh));
}

TEST(EllipsoidBound, IsAboveTheDistanceAndNotByMuch) {
    const TriangleMesh fine = leaning_mesh(6);
    for (const int level : {2, 3, 4}) {
        const TriangleMesh coarse = leaning_mesh(level);
        const std::optional<double> bound = bound_of(leaning(), coarse);
        ASSERT_TRUE(bound) << level;
        const double distance = measure_deviation(coarse, fine, {}).max();
        EXPECT_GT(*bound, distance);
        EXPECT_LT(*bound, 2.5 * distance);
    }
}

TEST(EllipsoidBound, SeesADentAndABump) {
    for (const double factor : {0.9, 1.1}) {
        TriangleMesh mesh = leaning_mesh(5);
        const Vec3 centre{0, 0, 0.1}, moved = mesh.vertices[7] - centre;
        mesh.vertices[7] = centre + moved * factor;
        const std::optional<double> bound = bound_of(leaning(), mesh);
        ASSERT_TRUE(bound);
        EXPECT_GT(*bound, 0.099 * norm(moved));
        EXPECT_LT(*bound, 0.2 * norm(moved));
    }
}

TEST(EllipsoidBound, DoesNotAskWhichWayFacesPoint) {
    TriangleMesh mesh = leaning_mesh(3);
    const std::optional<double> outward = bound_of(leaning(), mesh);
    for (Triangle& face : mesh.faces) std::swap(face[0], face[1]);
    EXPECT_EQ(bound_of(leaning(), mesh), outward);
}

TEST(EllipsoidBound, SaysNothingOfWhatIsNoEllipsoidAroundAClosedMesh) {
    const TriangleMesh mesh = leaning_mesh(3);
    Quadric inside_out = leaning(), cylinder = leaning(), empty = leaning(), saddle = leaning();
    for (double& c : inside_out.c) c = -c;
    cylinder.c[2] = cylinder.c[8] = 0;
    empty.c[9] = -2;
    saddle.c[1] = 3;
    for (const Quadric& q : {inside_out, cylinder, empty, saddle}) EXPECT_FALSE(bound_of(q, mesh));

    TriangleMesh open = mesh, beside = mesh, twice = mesh, one_turned = mesh;
    open.faces.pop_back();
    for (Vec3& p : beside.vertices) p.y += 1;
    twice.faces.insert(twice.faces.end(), mesh.faces.begin(), mesh.faces.end());
    std::swap(one_turned.faces[3][0], one_turned.faces[3][1]);
    for (const TriangleMesh& m : {open, beside, twice, one_turned}) EXPECT_FALSE(bound_of(leaning(), m));
}

TEST(EllipsoidBound, ACrossingThroughTheCentreIsNoProof) {
    TriangleMesh mesh = leaning_mesh(3);
    mesh.vertices[5] = {0, 0, 0.1};
    EXPECT_FALSE(bound_of(leaning(), mesh));
}

}  // namespace
}  // namespace pfgeom
