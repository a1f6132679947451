#include "pfgeom/report/function_list.h"

#include "random_tree.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pfgeom {
namespace {

using Kind = QuadricKind;

// A plate that fills the box, with a hole of radius 1/4 along z and a plane that separates nothing.
Object plate_with_hole() {
    SetTree tree = test::box_tree(10, 1536);
    tree.quadrics = {test::of_family(4, {1024, 0, 0, -64}), test::of_family(0, {1, 100})};
    tree.nodes = {test::ask(0, 1, 4), test::ask(1, 2, 3), test::leaf(true), test::leaf(true),
                  test::leaf(false)};
    derive(tree);
    Object object;
    object.frame.scale_code = 16;  // half edge 4
    object.frame.offset = {8, 0, -16};
    object.shape = std::move(tree);
    return object;
}

Object solid_of(std::int32_t function) {
    Object object;
    object.frame.scale_code = 8;
    object.shape = Solid{{{SetNode::Kind::function, function}}};
    return object;
}

Model with_tolerance(double tolerance) {
    Model model;
    model.promise.tolerance = tolerance;
    model.diagonal = 1;
    return model;
}

TEST(FunctionList, AnEllipsoidMuchLongerThanWideIsStillOne) {
    Model model = with_tolerance(1e-2);
    model.functions.resize(1);
    // Half axes 0.95, 0.09 and 0.08 around (0, 0.04, -0.03).
    const double a = 1 / (0.95 * 0.95), b = 1 / (0.09 * 0.09), c = 1 / (0.08 * 0.08);
    model.functions[0].base = {{-a, -b, -c, 0, 0, 0, 0, 0.08 * b, -0.06 * c, 1 - 0.0016 * b - 0.0009 * c}};
    model.objects = {solid_of(0)};
    const std::vector<ListedFunction> list = list_functions(model);
    ASSERT_EQ(list.size(), 1U);
    EXPECT_EQ(list[0].shape.kind, Kind::ellipsoid);
}

TEST(FunctionList, AHoleInTheMeshsUnits) {
    Model model = with_tolerance(1e-3);
    model.objects = {plate_with_hole()};
    const std::vector<ListedFunction> list = list_functions(model);
    ASSERT_EQ(list.size(), 2U);
    const QuadricShape& hole = list[0].shape;
    EXPECT_EQ(hole.kind, Kind::circular_cylinder);
    EXPECT_DOUBLE_EQ(hole.sizes[0], 1);  // 1/4 of the half edge
    EXPECT_NEAR(norm(cross(hole.axes[0], Vec3{0, 0, 1})), 0, 1e-15);
    EXPECT_NEAR(hole.centre.x, 1, 1e-12);  // offset 8 of 32 half edges of 4
    EXPECT_NEAR(hole.centre.y, 0, 1e-12);
    EXPECT_TRUE(list[0].surface);
    EXPECT_TRUE(list[0].hollow);
    EXPECT_NEAR(list[0].area, 2 * std::numbers::pi * 6, 0.4);
    EXPECT_EQ(list[1].shape.kind, Kind::plane);
    EXPECT_FALSE(list[1].surface);
    EXPECT_EQ(list[1].area, 0);
}

TEST(FunctionList, WhatAnOperandsTransformMakesOfIt) {
    Model model = with_tolerance(1e-3);
    model.objects = {plate_with_hole()};
    Affine map;
    map.rows[0] = {2, 0, 0};
    map.translation = {0, 5, 0};
    model.combination.operands = {{1, model.diagonal, model.promise}};
    model.combination.transforms = {map};
    model.combination.steps = {{CombinationStep::Kind::operand, 0}, {CombinationStep::Kind::transform, 0}};
    const QuadricShape stretched = list_functions(model)[0].shape;
    EXPECT_EQ(stretched.kind, Kind::elliptic_cylinder);
    EXPECT_NEAR(stretched.sizes[0], 2, 1e-9);
    EXPECT_NEAR(stretched.sizes[1], 1, 1e-9);
    EXPECT_NEAR(norm(cross(stretched.axes[1], Vec3{1, 0, 0})), 0, 1e-9);
    EXPECT_NEAR(stretched.centre.x, 2, 1e-9);
    EXPECT_NEAR(stretched.centre.y, 5, 1e-9);

    model.combination.transforms[0].rows = {Vec3{0, -2, 0}, Vec3{2, 0, 0}, Vec3{0, 0, 2}};
    const ListedFunction turned = list_functions(model)[0];
    EXPECT_EQ(turned.shape.kind, Kind::circular_cylinder);
    EXPECT_NEAR(turned.shape.sizes[0], 2, 1e-9);
    EXPECT_NEAR(turned.area, 2 * std::numbers::pi * 6 * 4, 1.6);
}

TEST(FunctionList, APinIsNotHollow) {
    Model model = with_tolerance(1e-3);
    Object pin = plate_with_hole();
    auto& tree = std::get<SetTree>(pin.shape);
    std::swap(tree.nodes[2].kind, tree.nodes[4].kind);
    tree.nodes[3].kind = TreeNode::Kind::outside;
    model.objects = {plate_with_hole(), pin};
    const std::vector<ListedFunction> list = list_functions(model);
    ASSERT_EQ(list.size(), 4U);
    EXPECT_EQ(list[2].object, 1);
    EXPECT_EQ(list[2].shape.kind, Kind::circular_cylinder);
    EXPECT_FALSE(list[2].hollow);
    EXPECT_TRUE(list[2].surface);
}

TEST(FunctionList, FunctionsOfSolidsAndSheetsOnce) {
    Model model = with_tolerance(1e-3);
    Function sphere, plane, bumpy;
    sphere.base = {{-1, -1.00001, -1, 0, 0, 0, 0, 0, 0, 0.25}};  // to float precision
    plane.base = {{0, 0, 0, 0, 0, 0, 0, 0, 1, 0}};
    bumpy.base = {{-1, -2, -4, 0, 0, 0, 0, 0, 0, 0.25}};
    bumpy.perturbations = {{0.5, sphere.base}};
    model.functions = {sphere, plane, bumpy};
    Object sheet;
    sheet.shape = Sheet{1, 0, {}};
    model.objects = {sheet, solid_of(0), solid_of(2), solid_of(0)};
    const std::vector<ListedFunction> list = list_functions(model);
    ASSERT_EQ(list.size(), 3U);
    EXPECT_EQ(list[0].shape.kind, Kind::plane);
    EXPECT_TRUE(list[0].surface);
    EXPECT_EQ(list[1].shape.kind, Kind::sphere);
    EXPECT_TRUE(list[1].surface);  // a trim first, a surface later
    EXPECT_NEAR(list[1].shape.sizes[0], 0.5 * sheet.frame.half(), 1e-5);
    EXPECT_EQ(list[2].shape.kind, Kind::ellipsoid);
    EXPECT_EQ(list[2].perturbations, 1);
    EXPECT_EQ(list[2].object, 2);
    EXPECT_DOUBLE_EQ(list[2].shape.sizes[0], 1);  // half the half edge of 2
}

TEST(FunctionList, NothingOfMeshParts) {
    Model model = with_tolerance(1);
    model.objects.emplace_back().shape = MeshPart{};
    EXPECT_TRUE(list_functions(model).empty());
}

TEST(FunctionList, TakesAnyTree) {
    Random random(21);
    for (int round = 0; round < 40; ++round) {
        Model model = with_tolerance(std::ldexp(1.0, -round % 20));
        model.objects.emplace_back().shape = test::random_tree(random, 6);
        const auto& tree = std::get<SetTree>(model.objects[0].shape);
        const std::vector<ListedFunction> list = list_functions(model);
        ASSERT_EQ(list.size(), tree.quadrics.size());
        for (const ListedFunction& f : list) {
            EXPECT_TRUE(is_finite(f.shape.centre));
            for (const Vec3& axis : f.shape.axes) EXPECT_NEAR(norm(axis), 1, 1e-9);
            for (const double size : f.shape.sizes) EXPECT_TRUE(std::isfinite(size) && size >= 0);
            EXPECT_EQ(f.surface, f.area > 0);
        }
    }
}

// Once for all copies, in the place of the first.
TEST(FunctionList, APatternsFunctionsAreListedOnce) {
    Model model = with_tolerance(1e-3);
    model.objects = {plate_with_hole()};
    Placements& p = model.objects[0].placements;
    p.scale_steps = 2;
    p.origin = {10, 20, 30};
    p.list = {{{1, 1, 0, 0}, false, 1, {0, 0, 0}},
              {{1, 0, 0, 0}, true, 2, {9, 0, 0}}};  // about x, half as large
    const std::vector<ListedFunction> list = list_functions(model);
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[0].copies, 2);
    const QuadricShape& hole = list[0].shape;
    EXPECT_DOUBLE_EQ(hole.sizes[0], 0.5);
    EXPECT_NEAR(norm(cross(hole.axes[0], Vec3{0, 1, 0})), 0, 1e-15);
    EXPECT_NEAR(hole.centre.x, 10, 1e-12);
    EXPECT_NEAR(hole.centre.z, 30, 1e-12);
    EXPECT_NEAR(list[0].area, 2 * std::numbers::pi * 6 / 4, 0.1);
}

}  // namespace
}  // namespace pfgeom
