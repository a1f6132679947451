// A set tree as an object of a model, from the file to its mesh.
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "random_tree.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

// The ball |p| <= 1/2 where z >= -1/4, and a second copy of the ball's quadric that nobody needs.
Model cut_ball() {
    SetTree tree = test::box_tree(10, 1100);
    TreeQuadric ball;
    ball.family = 7;
    ball.n = {-1024, 0, 0, 0, 256};  // 1/4 - |p|²
    TreeQuadric plane;
    plane.family = 2;
    plane.n = {1, 256};
    tree.quadrics = {ball, plane, ball};
    const auto ask = [](std::int32_t quadric, std::int32_t high, std::int32_t low) {
        TreeNode node;
        node.kind = TreeNode::Kind::ask;
        node.quadric = quadric;
        return test::with_children(node, high, low);
    };
    tree.nodes = {ask(0, 1, 6),      ask(1, 2, 5),      ask(2, 3, 4),     test::leaf(true),
                  test::leaf(false), test::leaf(false), test::leaf(false)};
    derive(tree);
    Model model;
    model.diagonal = 2;
    model.promise = {Metric::max, 2e-2, 2e-2, false, 1e-2};
    Object object;
    object.frame.scale_code = 8;  // twice as large
    object.shape = tree;
    object.mesh_code = 36;
    model.objects.push_back(object);
    return model;
}

double signed_volume(const TriangleMesh& mesh) {
    double volume = 0;
    for (const Triangle& t : mesh.faces) {
        const auto corner = [&](int i) {
            return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])];
        };
        volume += dot(corner(0), cross(corner(1), corner(2))) / 6;
    }
    return volume;
}

TEST(TreeModel, SurvivesTheFile) {
    const Model model = cut_ball();
    const Result<Model> back = decode(encode(model));
    ASSERT_TRUE(back);
    EXPECT_EQ(std::get<SetTree>(back->objects[0].shape), std::get<SetTree>(model.objects[0].shape));
    const SizeReport sizes = measure_size(model);
    ASSERT_EQ(sizes.bytes_of_object.size(), 1U);
    EXPECT_NEAR(sizes.bytes_of_object[0] + static_cast<double>(sizes.head), static_cast<double>(sizes.total),
                1);
}

TEST(TreeModel, DistinctQuadricsCount) {
    const FunctionCount count = count_functions(cut_ball());
    EXPECT_EQ(count.surface, 2);
    EXPECT_EQ(count.separators, 0);
    EXPECT_EQ(count.mesh_part_faces, 0);
}

TEST(TreeModel, FieldIsInTheWorld) {
    const ModelField field(cut_ball());
    EXPECT_TRUE(field.contains({0, 0, 0}));
    EXPECT_NEAR(field.value({0.9, 0, 0}), 0.1, 0.02);
    EXPECT_NEAR(field.value({0, 0, -0.6}), -0.1, 1e-12);
    EXPECT_FALSE(field.contains({0, 0, -0.51}));
    EXPECT_FALSE(field.contains({0, 0, 3}));
    const Box box = field.bounds();
    EXPECT_NEAR(box.hi.x, 1100.0 / 1024, 1e-12);
    EXPECT_NEAR(box.lo.z, -1100.0 / 1024, 1e-12);
}

TEST(TreeModel, MeshHasItsVolumeAndFacesTurnWithTheComplement) {
    Model model = cut_ball();
    // Of the ball of radius 1 without the cap below -1/2: 4/3 pi - pi/4 (1 - 1/6).
    const double expected = 3.14159265358979 * (4.0 / 3 - 0.25 * (1 - 1.0 / 6));
    EXPECT_NEAR(signed_volume(to_mesh(model)), expected, 0.02 * expected);
    std::get<SetTree>(model.objects[0].shape).complement = true;
    EXPECT_NEAR(signed_volume(to_mesh(model)), -expected, 0.02 * expected);
}

}  // namespace
}  // namespace pfgeom
