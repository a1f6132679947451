#include "pfgeom/function/quadric_shape.h"

#include "pfgeom/base/random.h"
#include "pfgeom/function/turned_quadric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace pfgeom {
namespace {

using Kind = QuadricKind;

double symmetric(Random& random) {
    return 2 * random.uniform() - 1;
}

Vec3 random_vector(Random& random) {
    const double x = symmetric(random), y = symmetric(random);
    return {x, y, symmetric(random)};
}

std::array<Vec3, 3> random_axes(Random& random) {
    const Vec3 a = normalized(random_vector(random) + Vec3{0, 0, 1e-3});
    const Vec3 b = normalized(cross(a, random_vector(random)));
    return {a, b, cross(a, b)};
}

/// Multiplied out.
Quadric expanded(const TurnedQuadric& t) {
    Quadric q;
    std::array<Vec3, 3> rows{};  // of the squares' matrix
    Vec3 linear;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& a = t.axes[i];
        for (int r = 0; r < 3; ++r) rows[static_cast<std::size_t>(r)] += t.squares[i] * a[r] * a;
        linear += t.linear[i] * a;
    }
    const auto times = [&](const Vec3& v) { return Vec3{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; };
    const Vec3 moved = linear - 2 * times(t.origin);
    const double constant = dot(t.origin, times(t.origin)) - dot(linear, t.origin) + t.constant;
    q.c = {rows[0].x,     rows[1].y, rows[2].z, 2 * rows[0].y, 2 * rows[0].z,
           2 * rows[1].z, moved.x,   moved.y,   moved.z,       constant};
    return q;
}

/// A canonical equation in its own frame, and what is to be read off it there.
struct Example {
    Kind kind;
    std::array<double, 3> squares, linear;
    double constant;
    std::array<double, 3> sizes;
    std::size_t axis;   ///< that axes[0] is
    bool whole_centre;  ///< the centre has no freedom left
};

const std::vector<Example> kExamples{
    {Kind::plane, {0, 0, 0}, {0, 0, -2}, 0, {}, 2, false},
    {Kind::parallel_planes, {0, 0, -4}, {0, 0, 0}, 1, {0.5}, 2, false},
    {Kind::crossing_planes, {1, -4, 0}, {0, 0, 0}, 0, {0.5}, 2, false},
    {Kind::sphere, {-1, -1, -1}, {0, 0, 0}, 0.25, {0.5, 0.5, 0.5}, 3, true},
    {Kind::spheroid, {-4, -4, -1}, {0, 0, 0}, 1, {1, 0.5, 0.5}, 2, true},
    {Kind::spheroid, {-1, -1, -4}, {0, 0, 0}, 1, {0.5, 1, 1}, 2, true},
    {Kind::ellipsoid, {-16, -4, -1}, {0, 0, 0}, 1, {1, 0.5, 0.25}, 2, true},
    {Kind::circular_cylinder, {-2, -2, 0}, {0, 0, 0}, 0.5, {0.5, 0.5}, 2, false},
    {Kind::elliptic_cylinder, {-1, -4, 0}, {0, 0, 0}, 1, {1, 0.5}, 2, false},
    {Kind::parabolic_cylinder, {-1, 0, 0}, {0, 2, 0}, 0, {0.5}, 2, false},
    {Kind::hyperbolic_cylinder, {4, -1, 0}, {0, 0, 0}, -1, {0.5, 1}, 2, false},
    {Kind::circular_cone, {-4, -4, 1}, {0, 0, 0}, 0, {0.5, 0.5}, 2, true},
    {Kind::elliptic_cone, {-1, -4, 1}, {0, 0, 0}, 0, {1, 0.5}, 2, true},
    {Kind::circular_paraboloid, {-1, -1, 0}, {0, 0, 2}, 0, {0.5, 0.5}, 2, true},
    {Kind::elliptic_paraboloid, {-1, -2, 0}, {0, 0, 2}, 0, {0.5, 0.25}, 2, true},
    {Kind::hyperbolic_paraboloid, {-1, 2, 0}, {0, 0, 2}, 0, {0.5, 0.25}, 2, true},
    {Kind::circular_one_sheet, {-4, -4, 1}, {0, 0, 0}, 1, {1, 0.5, 0.5}, 2, true},
    {Kind::one_sheet, {-1, -4, 1}, {0, 0, 0}, 1, {1, 1, 0.5}, 2, true},
    {Kind::circular_two_sheets, {-4, -4, 1}, {0, 0, 0}, -1, {1, 0.5, 0.5}, 2, true},
    {Kind::two_sheets, {-1, -4, 1}, {0, 0, 0}, -1, {1, 1, 0.5}, 2, true},
    {Kind::line, {-1, -4, 0}, {0, 0, 0}, 0, {}, 2, false},
    {Kind::point, {-1, -4, -2}, {0, 0, 0}, 0, {}, 3, true},
    {Kind::nothing, {-1, -4, -2}, {0, 0, 0}, -1, {}, 3, false},
    {Kind::nothing, {-1, -4, 0}, {0, 0, 0}, -1, {}, 3, false},
    {Kind::nothing, {-1, 0, 0}, {0, 0, 0}, -1, {}, 3, false},
    {Kind::nothing, {0, 0, 0}, {0, 0, 0}, 1, {}, 3, false},
};

TurnedQuadric placed(const Example& e, const std::array<Vec3, 3>& axes, const Vec3& origin, double factor) {
    TurnedQuadric t{origin, axes, e.squares, e.linear, factor * e.constant};
    for (double& s : t.squares) s *= factor;
    for (double& l : t.linear) l *= factor;
    return t;
}

/// Is the shape the one that the example stands for, up to `slack`?
void expect_shape(const QuadricShape& shape, const Example& e, const TurnedQuadric& t, double slack,
                  const std::string& what) {
    ASSERT_EQ(name_of(shape.kind), name_of(e.kind)) << what;
    for (std::size_t i = 0; i < 3 && e.sizes[i] > 0; ++i) {
        EXPECT_NEAR(shape.sizes[i], e.sizes[i], slack) << what << ", size " << i;
    }
    if (e.axis < 3) {
        EXPECT_LT(norm(cross(shape.axes[0], t.axes[e.axis])), slack) << what;
    }
    if (e.whole_centre) {
        EXPECT_LT(norm(shape.centre - t.origin), slack) << what;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(dot(shape.axes[i], shape.axes[i]), 1, 1e-12) << what;
        EXPECT_NEAR(dot(shape.axes[i], shape.axes[(i + 1) % 3]), 0, 1e-12) << what;
    }
}

TEST(QuadricShape, EveryKindInEveryPlace) {
    Random random(1);
    for (int round = 0; round < 100; ++round) {
        const std::array<Vec3, 3> axes = random_axes(random);
        const Vec3 origin = random_vector(random);
        const double factor = (round % 2 == 0 ? 1 : -1) * std::ldexp(1 + random.uniform(), round % 60 - 30);
        for (const Example& e : kExamples) {
            const TurnedQuadric t = placed(e, axes, origin, factor);
            const std::string what = std::string(name_of(e.kind)) + ", round " + std::to_string(round);
            expect_shape(shape_of(expanded(t)), e, t, 1e-6, what);
        }
    }
}

TEST(QuadricShape, AlongAxesWithoutRounding) {
    for (const Example& e : kExamples) {
        const TurnedQuadric t = placed(e, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, {0.25, -0.5, 0.75}, 2);
        expect_shape(shape_of(expanded(t)), e, t, 1e-15, std::string(name_of(e.kind)));
    }
}

TEST(QuadricShape, APlaneLooksAwayFromThePositiveSide) {
    const QuadricShape plane = shape_of(Quadric{{0, 0, 0, 0, 0, 0, 0, 3, 4, 5}});
    EXPECT_EQ(plane.kind, Kind::plane);
    EXPECT_LT(norm(plane.axes[0] - Vec3{0, -0.6, -0.8}), 1e-15);
    EXPECT_LT(norm(plane.centre - Vec3{0, -0.6, -0.8}), 1e-15);
}

TEST(QuadricShape, OpeningsAndSaddles) {
    // y = x²/2 and z = x²/2 - y²
    const QuadricShape cylinder = shape_of(Quadric{{-0.5, 0, 0, 0, 0, 0, 0, 1, 0, 0}});
    EXPECT_EQ(cylinder.axes[1], (Vec3{0, 1, 0}));
    const QuadricShape saddle = shape_of(Quadric{{-0.5, 1, 0, 0, 0, 0, 0, 0, 1, 0}});
    EXPECT_EQ(saddle.axes[0], (Vec3{0, 0, 1}));
    EXPECT_LT(norm(cross(saddle.axes[1], Vec3{1, 0, 0})), 1e-15);
    EXPECT_DOUBLE_EQ(saddle.sizes[0], 0.5);
    EXPECT_DOUBLE_EQ(saddle.sizes[1], 0.25);
    const QuadricShape bowl = shape_of(Quadric{{1, 2, 0, 0, 0, 0, 0, 0, 1, 3}});
    EXPECT_EQ(bowl.axes[0], (Vec3{0, 0, -1}));
    EXPECT_EQ(bowl.centre, (Vec3{0, 0, -3}));
}

// --- within a tolerance over an extent
// ------------------------------------------------------------------------

/// Where rays through a box meet the quadric, as reports take them.
std::vector<Vec3> points_on(const Quadric& q, const Vec3& middle, double half, int steps = 12) {
    std::vector<Vec3> points;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < steps * steps; ++i) {
            Vec3 p = middle;
            p[(axis + 1) % 3] += half * ((2 * (i % steps) + 1.0) / steps - 1);
            p[(axis + 2) % 3] += half * ((2 * (i / steps) + 1.0) / steps - 1);
            double before = 0;
            for (int k = 0; k <= 40; ++k) {
                Vec3 at = p;
                at[axis] += half * (k / 20.0 - 1);
                const double value = q.value(at);
                if (k > 0 && before * value < 0) {
                    Vec3 lo = at, hi = at;
                    lo[axis] -= half / 20;
                    for (int b = 0; b < 60; ++b) {
                        const Vec3 mid = (lo + hi) * 0.5;
                        (q.value(mid) * before > 0 ? lo : hi) = mid;
                    }
                    points.push_back(lo);
                }
                before = value;
            }
        }
    }
    return points;
}

bool is_surface(const Example& e) {
    return e.kind != Kind::line && e.kind != Kind::point && e.kind != Kind::nothing;
}

/// All ten coefficients off by up to a share of the mean slope at the points.
Quadric disturbed(Quadric q, const std::vector<Vec3>& points, double by, Random& random) {
    double slope = 0;
    for (const Vec3& p : points) slope += norm(q.gradient(p)) / static_cast<double>(points.size());
    for (double& c : q.c) c += by * slope * symmetric(random);
    return q;
}

TEST(QuadricShape, EveryKindIsSeenThroughRounding) {
    Random random(2);
    for (int round = 0; round < 12; ++round) {
        const std::array<Vec3, 3> axes = random_axes(random);
        const Vec3 origin = 0.2 * random_vector(random);
        for (const Example& e : kExamples) {
            if (!is_surface(e)) continue;
            const TurnedQuadric t = placed(e, axes, origin, 1);
            // Where planes cross, a change of coefficients moves the surface by its square root.
            const double by = e.kind == Kind::crossing_planes ? 1e-9 : 1e-5;
            const std::vector<Vec3> points = points_on(expanded(t), origin, 1.6);
            const Quadric rounded = disturbed(expanded(t), points, by, random);
            const std::vector<Vec3> on = points_on(rounded, origin, 1.6);
            const std::string what = std::string(name_of(e.kind)) + ", round " + std::to_string(round);
            expect_shape(shape_of(rounded, on, 2e-4), e, t, 0.02, what);
        }
    }
}

TEST(QuadricShape, AFoundShapeStaysWithinTheTolerance) {
    // Whatever ten coefficients: the shape's own distances to the points say so, where it has simple ones.
    Random random(3);
    int curved = 0;
    for (int round = 0; round < 200; ++round) {
        Quadric q;
        for (double& c : q.c) c = symmetric(random);
        const double scale = std::ldexp(1.0, -round % 8);  // of curvature
        for (std::size_t i = 0; i < 6; ++i) q.c[i] *= scale;
        const std::vector<Vec3> points = points_on(q, {}, 0.5);
        if (points.size() < 20) continue;
        const double tolerance = 0.02;
        const QuadricShape shape = shape_of(q, points, tolerance);
        for (const Vec3& p : points) {
            const Vec3 d = p - shape.centre;
            const double along = dot(d, shape.axes[0]), off = norm(d - along * shape.axes[0]);
            if (shape.kind == Kind::plane) {
                EXPECT_LE(std::abs(along), tolerance * (1 + 1e-9));
            } else if (shape.kind == Kind::sphere) {
                EXPECT_LE(std::abs(norm(d) - shape.sizes[0]), 1.1 * tolerance);
                ++curved;
            } else if (shape.kind == Kind::circular_cylinder) {
                EXPECT_LE(std::abs(off - shape.sizes[0]), 1.1 * tolerance);
                ++curved;
            }
        }
    }
    EXPECT_GT(curved, 1000);
}

TEST(QuadricShape, TheExtentDecides) {
    // A sphere of radius 100: its sagitta over half the cube's diagonal of 0.87 is 3.75e-3.
    Random random(4);
    const std::array<Vec3, 3> axes = random_axes(random);
    const TurnedQuadric sphere{100 * axes[0], axes, {-1, -1, -1}, {}, 1e4};
    const Quadric q = expanded(sphere);
    const std::vector<Vec3> points = points_on(q, {}, 0.5);
    EXPECT_EQ(shape_of(q, points, 4e-3).kind, Kind::plane);
    EXPECT_LT(norm(cross(shape_of(q, points, 4e-3).axes[0], axes[0])), 1e-3);
    const QuadricShape found = shape_of(q, points, 2e-4);
    EXPECT_EQ(found.kind, Kind::sphere);
    EXPECT_NEAR(found.sizes[0], 100, 1e-4);
    EXPECT_EQ(shape_of(q).kind, Kind::sphere);
}

TEST(QuadricShape, LimitsOfKinds) {
    // A cone of a ten thousandth is a cylinder, one of a tenth is not; a spheroid of nearly equal axes a
    // sphere; a hyperbola near its crossing two planes.
    Random random(5);
    const std::array<Vec3, 3> axes = random_axes(random);
    const auto kind_of = [&](const TurnedQuadric& t, const Vec3& middle, double tolerance) {
        const Quadric q = expanded(t);
        return shape_of(q, points_on(q, middle, 0.5), tolerance).kind;
    };
    for (const double tangent : {1e-4, 0.1}) {
        const Vec3 apex = -0.3 / tangent * axes[0];  // the radius is 0.3 at the origin
        const TurnedQuadric cone{apex, axes, {tangent * tangent, -1, -1}, {}, 0};
        EXPECT_EQ(kind_of(cone, {}, 1e-3), tangent < 0.01 ? Kind::circular_cylinder : Kind::circular_cone);
    }
    EXPECT_EQ(kind_of({{}, axes, {-1, -1.001, -1.002}, {}, 0.16}, {}, 1e-3), Kind::sphere);
    EXPECT_EQ(kind_of({{}, axes, {-1, -1, -1.1}, {}, 0.16}, {}, 1e-3), Kind::spheroid);
    EXPECT_EQ(kind_of({{}, axes, {-1, -1.5, -2.1}, {}, 0.16}, {}, 1e-3), Kind::ellipsoid);
    EXPECT_EQ(kind_of({{}, axes, {1, -2, 0}, {}, 1e-8}, {}, 1e-3), Kind::crossing_planes);
    EXPECT_EQ(kind_of({{}, axes, {1, -2, 0}, {}, 1e-2}, {}, 1e-3), Kind::hyperbolic_cylinder);
    EXPECT_EQ(kind_of({{}, axes, {1, 1e-4, 0}, {0, 0, 0}, -0.04}, {}, 1e-3), Kind::parallel_planes);
}

TEST(QuadricShape, ACylinderStaysOneHoweverShort) {
    // A strip of it would fit a sphere, too; but its coefficients are those of a cylinder.
    const Quadric q{{-1, -1, 0, 0, 0, 0, 0, 0, 0, 0.16}};
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) {
        const double x = 0.4 * (i / 20.0 - 1) * 0.999;
        points.push_back({x, std::sqrt(0.16 - x * x), 1e-4 * (i % 3)});
    }
    EXPECT_EQ(shape_of(q, points, 1e-3).kind, Kind::circular_cylinder);
}

TEST(QuadricShape, NoPointsOrOneOrNoSlope) {
    const Quadric q{{-1, -1, 0, 0, 0, 0, 0, 0, 0, 0.16}};
    EXPECT_EQ(shape_of(q, {}, 1).kind, Kind::circular_cylinder);
    const std::vector<Vec3> one{{0.4, 0, 0}};
    EXPECT_EQ(shape_of(q, one, 1).kind, Kind::circular_cylinder);
    const std::vector<Vec3> flat{{0, 0, 0}, {0, 0, 1}};
    EXPECT_EQ(shape_of(Quadric{}, flat, 1).kind, Kind::nothing);
    EXPECT_EQ(shape_of(Quadric{{1, 1}}, flat, 1).kind, Kind::line);
}

TEST(QuadricShape, ScalesWithThePiece) {
    Random random(6);
    const std::array<Vec3, 3> axes = random_axes(random);
    for (const double scale : {1e-6, 1.0, 1e6}) {
        const TurnedQuadric t{scale * Vec3{0.1, 0.2, -0.1}, axes, {-4, -4, 1}, {}, 0};
        const Quadric q = expanded(t);
        std::vector<Vec3> points = points_on(q, t.origin + 0.4 * scale * axes[2], 0.3 * scale);
        const QuadricShape shape = shape_of(q, points, 1e-3 * scale);
        EXPECT_EQ(shape.kind, Kind::circular_cone) << scale;
        EXPECT_NEAR(shape.sizes[0], 0.5, 1e-6);
        EXPECT_LT(norm(shape.centre - t.origin), 1e-6 * scale);
    }
}

}  // namespace
}  // namespace pfgeom
