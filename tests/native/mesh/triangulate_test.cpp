#include "pfgeom/mesh/triangulate.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace pfgeom {
namespace {

constexpr std::int64_t kPlenty = 1'000'000;

std::vector<Triangle> triangulate(const std::vector<Vec3>& polygon, std::int64_t budget = kPlenty) {
    std::vector<std::int32_t> corners(polygon.size());
    std::iota(corners.begin(), corners.end(), 0);
    return triangulate_polygon(polygon, corners, budget);
}

Vec3 area_vector(const std::vector<Vec3>& p, const Triangle& f) {
    return cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]) / 2;
}

/// A proper triangulation of a plane polygon: no triangle turned, and together the polygon's area.
void expect_proper(const std::vector<Vec3>& polygon) {
    Vec3 whole;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        whole += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]) / 2;
    double sum = 0;
    const std::vector<Triangle> faces = triangulate(polygon);
    for (const Triangle& face : faces) {
        EXPECT_GE(dot(area_vector(polygon, face), whole), -1e-12 * dot(whole, whole));
        sum += norm(area_vector(polygon, face));
    }
    EXPECT_EQ(faces.size(), polygon.size() - 2);
    EXPECT_NEAR(sum, norm(whole), 1e-9 * norm(whole));
}

/// A star with `rays` points, in a tilted plane.
std::vector<Vec3> star(int rays, double inner, const Vec3& u, const Vec3& v) {
    std::vector<Vec3> points;
    for (int i = 0; i < 2 * rays; ++i) {
        const auto [c, s] = shapes::on_circle(i / (2.0 * rays));
        points.push_back((u * c + v * s) * (i % 2 ? inner : 1.0));
    }
    return points;
}

TEST(Triangulate, ConvexPolygonsAreFans) {
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
              (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, ConcavePolygonsInAnyPlaneAndDirection) {
    for (const auto& [u, v] : {std::pair<Vec3, Vec3>{{1, 0, 0}, {0, 1, 0}},
                               {{0, 1, 0}, {1, 0, 0}},
                               {{0, 1, 0.1}, {0, 0, 1}},
                               {{1, 0.5, 0}, {0, 0.3, -1}},
                               {{1, 1, 1}, {-1, 1, 0}}})
        for (const int rays : {3, 5, 50}) expect_proper(star(rays, 0.3, u, v));
    expect_proper(
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});  // U
    expect_proper({{4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {0, 0, 0}});                                    // arrow
}

TEST(Triangulate, AHoleWithABridge) {
    expect_proper({{0, 0, 0},
                   {4, 0, 0},
                   {4, 4, 0},
                   {0, 4, 0},
                   {0, 0, 0},
                   {1, 1, 0},
                   {1, 3, 0},
                   {3, 3, 0},
                   {3, 1, 0},
                   {1, 1, 0}});
}

TEST(Triangulate, CornersOnAStraightSideGiveNoFlatTriangle) {
    const std::vector<Vec3> polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    for (const Triangle& face : triangulate(polygon)) EXPECT_GT(norm(area_vector(polygon, face)), 0.1);
}

TEST(Triangulate, ImpossiblePolygonsEndAndUseEveryCorner) {
    const std::vector<Vec3> bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Vec3> point(9, Vec3{1, 2, 3});
    std::vector<Vec3> pentagram = star(5, 1, {1, 0, 0}, {0, 1, 0});
    pentagram = {pentagram[0], pentagram[4], pentagram[8], pentagram[2], pentagram[6]};
    for (const auto& polygon : {bow, point, pentagram})
        EXPECT_EQ(triangulate(polygon).size(), polygon.size() - 2);
}

TEST(Triangulate, WithoutBudgetAFan) {
    const std::vector<Vec3> polygon = star(50, 0.3, {1, 0, 0}, {0, 1, 0});
    const std::vector<Triangle> faces = triangulate(polygon, 10);
    for (std::size_t i = 0; i < faces.size(); ++i)
        EXPECT_EQ(faces[i], (Triangle{0, static_cast<int>(i) + 1, static_cast<int>(i) + 2}));
}

}  // namespace
}  // namespace pfgeom
