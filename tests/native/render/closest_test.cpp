#include "pfgeom/render/closest.h"

#include "brute_force.h"
#include "codec/random_model.h"
#include "pfgeom/eval/solid_field.h"
#include "pfgeom/render/ray_solid.h"
#include "pfgeom/render/ray_tree.h"
#include "random_tree.h"

#include <gtest/gtest.h>

#include <thread>

namespace pfgeom {
namespace {

using Kind = SetNode::Kind;

constexpr double kAccuracy = 1e-5, kInf = Box::kInf;
const Task kTask{};
const Frame kUnit{};
const Box kCube{{-1, -1, -1}, {1, 1, 1}};

// What was found lies on a change of sides, and no point of the other side is nearer than proved: neither of
// many in the cube, nor of those just nearer than the answer.
struct Verdict {
    int found = 0, open = 0, off = 0, refuted = 0;
};

Verdict judge(const RayTarget& target, const test::Inside& inside, std::uint64_t seed, int points) {
    Random random(seed);
    ExtremeSearch search(kTask);
    Verdict verdict;
    std::vector<Vec3> others;
    for (int i = 0; i < 4000; ++i) others.push_back(test::any_point(random, 1.02));
    for (int i = 0; i < points; ++i) {
        const Vec3 p = test::any_point(random, i % 2 == 0 ? 1.5 : 0.7);
        const bool here = inside(p);
        const Extreme nearest = target.extreme({p, false}, kInf, kAccuracy, search);
        for (const Vec3& q : others) {
            if (inside(q) != here && norm(q - p) < nearest.proved) ++verdict.refuted;
        }
        for (int k = 0; k < 200; ++k) {
            const Vec3 aside = 0.05 * test::any_point(random);
            const Vec3 way = normalized(nearest.point + aside - p);
            const Vec3 q = p + way * (nearest.proved * (1 - 1e-9) - 1e-9);
            if (nearest.found() && inside(q) != here) ++verdict.refuted;
        }
        if (!nearest.found()) continue;
        ++verdict.found;
        verdict.open += nearest.cost - nearest.proved > 1.001 * kAccuracy ? 1 : 0;
        const Vec3 back = normalized(p - nearest.point) * 2e-9;
        const bool changes = inside(nearest.point + back) == here &&
                             (inside(nearest.point) != here || inside(nearest.point - back) != here);
        verdict.off += !changes && nearest.cost > 1e-8 ? 1 : 0;
        EXPECT_NEAR(nearest.cost, norm(p - nearest.point), 1e-14);
    }
    return verdict;
}

TEST(Closest, AsBruteForceOnRandomTrees) {
    Random random(5);
    int found = 0;
    for (int i = 0; i < 40; ++i) {
        const SetTree tree = test::random_tree(random, 6);
        const auto inside = [&](const Vec3& p) { return tree.box().contains(p) && contains(tree, p); };
        const Verdict verdict = judge(RayTree(tree, kUnit, {}), inside, 100U + i, 60);
        EXPECT_EQ(verdict.refuted, 0) << i;
        EXPECT_EQ(verdict.off, 0) << i;
        EXPECT_EQ(verdict.open, 0) << i;
        found += verdict.found;
    }
    EXPECT_GT(found, 1000);
}

Function bumpy(Random& random, int last_level) {
    Function function = test::random_hierarchy(random, last_level);
    function.perturbations.push_back({0.3, {{-4, -5, -6, 0, 0, 0, 1, 0, 2, 0.2}}});
    return function;
}

TEST(Closest, AsBruteForceOnFunctions) {
    Random random(8);
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        Model model;
        model.functions = {bumpy(random, 4)};
        const Solid solid{{{Kind::function, 0, -1, -1}}};
        const SolidField field(model, solid);
        const auto inside = [&](const Vec3& p) { return kCube.contains(p) && field.value(p) >= 0; };
        const Verdict verdict = judge(RaySolid(model, solid, kUnit, {}), inside, seed, 60);
        EXPECT_EQ(verdict.refuted, 0);
        EXPECT_EQ(verdict.off, 0);
        EXPECT_EQ(verdict.open, 0);
        EXPECT_GT(verdict.found, 50);
    }
}

// Intersections of two bumpy functions, what one leaves of the other, and a choice between them.
TEST(Closest, AsBruteForceOnSetExpressions) {
    Random random(9);
    const std::vector<std::vector<SetNode>> tails = {{{Kind::intersect, 0, 1}},
                                                     {{Kind::unite, 0, 1}},
                                                     {{Kind::complement, 1}, {Kind::intersect, 0, 2}},
                                                     {{Kind::inside}, {Kind::decide, 0, 2, 1}}};
    for (std::size_t i = 0; i < tails.size(); ++i) {
        Model model;
        model.functions = {bumpy(random, 3), bumpy(random, 2)};
        Solid solid{{{Kind::function, 0}, {Kind::function, 1}}};
        solid.nodes.insert(solid.nodes.end(), tails[i].begin(), tails[i].end());
        const SolidField field(model, solid);
        const auto inside = [&](const Vec3& p) { return kCube.contains(p) && field.value(p) >= 0; };
        const Verdict verdict = judge(RaySolid(model, solid, kUnit, {}), inside, i, 40);
        EXPECT_EQ(verdict.refuted, 0) << i;
        EXPECT_EQ(verdict.off, 0) << i;
        EXPECT_GT(verdict.found, 20) << i;
    }
}

// A disk at z = 1/4: the nearest point lies below, or on its rim.
TEST(Closest, SheetEndsAtItsTrim) {
    Model model;
    model.diagonal = 2;
    model.functions.resize(2);
    model.functions[0].base = {{0, 0, 0, 0, 0, 0, 0, 0, -1, 0.25}};
    model.functions[1].base = {{-1, -1, 0, 0, 0, 0, 0, 0, 0, 0.25}};
    model.objects.emplace_back();
    model.objects[0].shape = Sheet{0, 1, {}};
    const RayScene scene(model);
    ExtremeSearch search(kTask);
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = test::any_point(random, 1.3);
        const double r = std::sqrt(p.x * p.x + p.y * p.y), reach = std::min(r, 0.5);
        const Vec3 nearest{p.x * (reach / r), p.y * (reach / r), 0.25};
        const NearestPoint found = scene.nearest(p, 1e-6, search);
        EXPECT_NEAR(found.distance, norm(p - nearest), 1e-6);
        EXPECT_LE(found.proved, norm(p - nearest));
        EXPECT_GE(found.proved, found.distance - 1.001e-6);
        EXPECT_NEAR(found.point.z, 0.25, 1e-9);
    }
    const Box box = scene.bounds(1e-7);
    EXPECT_NEAR(box.lo.x, -0.5, 1e-6);
    EXPECT_NEAR(box.hi.y, 0.5, 1e-6);
    EXPECT_NEAR(box.lo.z, 0.25, 1e-6);
    EXPECT_NEAR(box.hi.z, 0.25, 1e-6);
}

// A ball cut by random planes: no point of it is nearer than what is proved, and the answer is one of them.
TEST(Closest, SheetEndsWhereItIsCut) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random(seed);
        Model model = test::ball();
        Sheet sheet{0, -1, {}};
        test::grow_material_tree(random, root_cell(), 4, 2, sheet.cut);
        std::vector<Vec3> kept;
        for (int i = 0; i < 20000; ++i) {
            const Vec3 p = normalized(test::any_point(random, 1)) * std::sqrt(0.5);
            if (material_at(sheet.cut, p) == Sheet::kKept) kept.push_back(p);
        }
        model.objects[0].shape = sheet;
        const RayScene scene(model);
        ExtremeSearch search(kTask);
        for (int i = 0; i < 100; ++i) {
            const Vec3 p = test::any_point(random, 1);
            double least = std::numeric_limits<double>::infinity();
            for (const Vec3& q : kept) least = std::min(least, norm(p - q));
            const NearestPoint found = scene.nearest(p, 1e-6, search);
            EXPECT_LE(found.proved, least + 1e-12);
            if (kept.empty()) continue;
            EXPECT_LE(found.distance, least + 1e-6) << seed;
            EXPECT_NEAR(norm(found.point), std::sqrt(0.5), 1e-9);
            EXPECT_EQ(material_at(sheet.cut, found.point), Sheet::kKept);
        }
    }
}

// Balls of radius s/√2: exact, and the object is told.
TEST(Closest, NearestOfManyCopies) {
    Model model = test::ball();
    Random random(4);
    for (int i = 0; i < 40; ++i) {
        model.objects[0].instances.push_back(test::random_similarity(random));
        model.objects[0].instances.back().scale = 0.2 + random.uniform();
    }
    const RayScene scene(model);
    ExtremeSearch search(kTask);
    Box all;
    for (const Similarity& s : copies_of(model.objects[0])) {
        const double r = s.scale * std::sqrt(0.5);
        all.grow(Box{s.translation - Vec3{r, r, r}, s.translation + Vec3{r, r, r}});
    }
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = test::any_point(random, 12);
        double nearest = kInf;
        for (const Similarity& s : copies_of(model.objects[0]))
            nearest = std::min(nearest, std::abs(norm(p - s.translation) - s.scale * std::sqrt(0.5)));
        const NearestPoint found = scene.nearest(p, 1e-6, search);
        EXPECT_NEAR(found.distance, nearest, 1e-8);
        EXPECT_NEAR(norm(p - found.point), nearest, 1e-8);
        EXPECT_LE(found.proved, nearest);
        EXPECT_EQ(found.object, 0);
    }
    const Box box = scene.bounds(1e-6);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(box.lo[axis], all.lo[axis]);
        EXPECT_GE(box.hi[axis], all.hi[axis]);
        EXPECT_NEAR(box.lo[axis], all.lo[axis], 3e-6);
        EXPECT_NEAR(box.hi[axis], all.hi[axis], 3e-6);
    }
}

// x² / a² + y² / b² turned by 30 degrees about z reaches sqrt(a² cos² + b² sin²) along x.
TEST(Closest, BoundsOfATurnedEllipsoid) {
    const double a = 0.8, b = 0.3, c = std::sqrt(0.75), s = 0.5;
    const double p = 1 / (a * a), q = 1 / (b * b);
    Model model = test::ball();
    model.diagonal = 2;
    model.objects[0].frame = kUnit;
    model.functions[0].base = {
        {-(p * c * c + q * s * s), -(p * s * s + q * c * c), -4, 2 * (q - p) * c * s, 0, 0, 0, 0, 0, 1}};
    const Box box = RayScene(model).bounds(1e-9);
    EXPECT_NEAR(box.hi.x, std::sqrt(a * a * c * c + b * b * s * s), 1e-8);
    EXPECT_NEAR(box.lo.y, -std::sqrt(a * a * s * s + b * b * c * c), 1e-8);
    EXPECT_NEAR(box.hi.z, 0.5, 1e-8);
}

// Whatever a file may hold: no crash, no endless search, and distances that are what they say.
TEST(Closest, AnyModel) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const Model model = test::random_model(seed);
        const RayScene scene(model);
        Box box;
        for (const Box& part : scene.cover()) box.grow(part);
        if (box.empty()) continue;
        Random random(seed);
        ExtremeSearch search(kTask);
        for (int i = 0; i < 2; ++i) {
            const Vec3 p = box.lo + (box.hi - box.lo) * (1.5 * random.uniform() - 0.25);
            const NearestPoint found = scene.nearest(p, 1e-4 * box.diagonal(), search);
            if (found.object < 0) continue;
            const double size = box.diagonal() + norm(p);
            EXPECT_NEAR(found.distance, norm(p - found.point), 1e-9 * size);
            EXPECT_LE(found.proved, found.distance);
            EXPECT_LE(box.squared_distance(found.point), 1e-12 * size * size);
        }
    }
}

std::vector<Vec3> many_points(int count) {
    Random random(1);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) points.push_back(test::any_point(random, 1.5));
    return points;
}

Model bumpy_model() {
    Random random(3);
    Model model = test::ball();
    model.functions = {bumpy(random, 4)};
    return model;
}

TEST(Closest, SameBitsOnAnyNumberOfThreads) {
    const RayScene scene(bumpy_model());
    std::vector<Vec3> points = many_points(300);
    points[7].x = std::numeric_limits<double>::quiet_NaN();
    const auto one = closest_points(scene, points, kAccuracy, {1, nullptr, {}});
    const auto three = closest_points(scene, points, kAccuracy, {3, nullptr, {}});
    EXPECT_EQ(one[7].object, -1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(one[i].point, three[i].point);
        EXPECT_EQ(one[i].distance, three[i].distance);
        EXPECT_EQ(one[i].proved, three[i].proved);
    }
}

TEST(Closest, CancelStopsTheSearch) {
    const RayScene scene(bumpy_model());
    CancelToken token;
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        token.cancel();
    });
    EXPECT_THROW(closest_points(scene, many_points(2'000'000), 1e-9, {2, &token, {}}), Cancelled);
    later.join();
}

}  // namespace
}  // namespace pfgeom
