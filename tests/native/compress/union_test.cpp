// A union of ellipsoids, from its mesh alone.
#include "pfgeom/compress/compress.h"
#include "pfgeom/fit/tree_quadric.h"
#include "random_tree.h"

#include <gtest/gtest.h>

#include <vector>

namespace pfgeom {
namespace {

// Positive within the ellipsoid; slopes of about one.
Quadric ellipsoid(const Vec3& centre, const Vec3& radii) {
    Quadric q;
    for (std::size_t d = 0; d < 3; ++d) {
        const double r = radii[static_cast<int>(d)], c = centre[static_cast<int>(d)];
        q.c[d] = -1 / (r * r);
        q.c[6 + d] = 2 * c / (r * r);
        q.c[9] -= c * c / (r * r);
    }
    q.c[9] += 1;
    for (double& c : q.c) c *= 0.15;
    return q;
}

// A little fish. The eye barely stands out, and the tail meets the body in a narrow crevice.
const std::vector<Quadric> kFish{
    ellipsoid({0, 0, 0}, {0.6, 0.25, 0.35}),          ellipsoid({0.72, 0, 0}, {0.2, 0.06, 0.3}),
    ellipsoid({0.05, 0, 0.33}, {0.25, 0.05, 0.2}),    ellipsoid({-0.1, 0.22, -0.1}, {0.15, 0.2, 0.04}),
    ellipsoid({-0.4, 0.15, 0.1}, {0.06, 0.05, 0.06}),
};

TriangleMesh fish_mesh() {
    constexpr int kResolution = 18;
    SetTree tree = test::box_tree(kResolution, 2 << kResolution);
    const auto count = static_cast<std::int32_t>(kFish.size());
    for (std::int32_t i = 0; i < count; ++i) {
        tree.quadrics.push_back(round_finely(kFish[static_cast<std::size_t>(i)], kResolution));
        TreeNode ask;
        ask.kind = TreeNode::Kind::ask;
        ask.quadric = i;
        tree.nodes.push_back(test::with_children(ask, 2 * i + 1, 2 * i + 2));
        tree.nodes.push_back(test::leaf(true));
    }
    tree.nodes.push_back(test::leaf(false));
    derive(tree);
    Model model;
    model.diagonal = 2;
    model.promise = {Metric::max, 1e-3, 1e-3, false, 1e-3};
    Object object;
    object.shape = tree;
    object.mesh_code = 40;  // chords of 2e-3
    model.objects.push_back(object);
    return to_mesh(model, {.thin = false});
}

TEST(Compress, AUnionOfEllipsoidsIsAsManyFunctions) {
    const Compressed fish = compress(fish_mesh(), {4e-3});
    ASSERT_EQ(fish.report.islands.size(), 1U);
    EXPECT_EQ(fish.report.islands[0].candidate, "tree");
    EXPECT_EQ(count_functions(fish.model).surface, static_cast<std::int64_t>(kFish.size()));
    EXPECT_LT(fish.bytes.size(), 120U);
    const Promise& promise = fish.model.promise;
    EXPECT_TRUE(promise.functions_certified);
    EXPECT_LE(promise.bound_functions, promise.tolerance);
    EXPECT_TRUE(promise.certified);
    EXPECT_LE(promise.bound_mesh, promise.tolerance);
    const auto& tree = std::get<SetTree>(fish.model.objects[0].shape);
    EXPECT_EQ(tree.nodes.size(), 2 * kFish.size() + 1) << "a chain";
}

}  // namespace
}  // namespace pfgeom
