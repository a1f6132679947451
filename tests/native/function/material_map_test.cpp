#include "pfgeom/function/material_map.h"

#include "codec/random_model.h"
#include "pfgeom/function/check.h"

#include <gtest/gtest.h>

#include <functional>

namespace pfgeom {
namespace {

MaterialTree cut_then_plane() {
    MaterialTree tree;
    tree.nodes.resize(5);
    tree.nodes[0] = {.axis = 0, .bits = 1, .offset = 1, .high = 1, .low = 2, .normal = {}};  // x >= 1/2
    tree.nodes[1].material = 7;
    tree.nodes[2] = {.axis = 1, .bits = 2, .tilt = {4, -2}, .offset = -1, .high = 3, .low = 4, .normal = {}};
    tree.nodes[3].material = 8;
    tree.nodes[4].material = 9;
    derive(tree.nodes[0], root_cell());
    derive(tree.nodes[2], low_cell(tree.nodes[0], root_cell()));
    return tree;
}

TEST(MaterialMap, QuestionsAreAskedInTheCellThatCutsLeave) {
    const MaterialTree tree = cut_then_plane();
    EXPECT_EQ(low_cell(tree.nodes[0], root_cell()).hi.x, 0.5);
    EXPECT_EQ(high_cell(tree.nodes[0], root_cell()).lo.x, 0.5);
    EXPECT_EQ(material_at(tree, {0.5, 0, 0}), 7);
    // y + z - (x + 1/4) / 2 >= -1/4, from the middle (-1/4, 0, 0) of the cell, whose longest side is 2
    for (const Vec3 p :
         {Vec3{0.1, 0.2, 0.3}, Vec3{-0.9, -0.4, 0.1}, Vec3{0.4, -0.1, -0.05}, Vec3{-0.2, -1, 0.6}})
        EXPECT_EQ(material_at(tree, p), p.y + p.z - (p.x + 0.25) / 2 >= -0.25 ? 8 : 9) << p.x;
}

std::string flaw_after(const std::function<void(MaterialMap&)>& change) {
    Model model = test::ball();
    model.materials.names.resize(10);
    model.materials.objects = {{Paint{{cut_then_plane()}, false}}};
    EXPECT_EQ(find_flaw(model), "");
    change(model.materials);
    return find_flaw(model);
}

TEST(MaterialMap, WhatIsWrongIsFound) {
    const auto node = [](MaterialMap& m, std::size_t i) -> MaterialNode& {
        return m.objects[0][0].trees[0].nodes[i];
    };
    const std::vector<std::function<void(MaterialMap&)>> changes{
        [](MaterialMap& m) { m.names.resize(9); },
        [](MaterialMap& m) { m.names.clear(); },
        [](MaterialMap& m) { m.names.resize(4097); },
        [](MaterialMap& m) { m.names[3] = std::string("\xFF"); },
        [](MaterialMap& m) { m.names[4].assign(256, 'a'); },
        [](MaterialMap& m) { m.objects.clear(); },
        [](MaterialMap& m) { m.objects.emplace_back(); },
        [](MaterialMap& m) { m.objects[0].clear(); },
        [](MaterialMap& m) { m.objects[0].resize(2, m.objects[0][0]); },
        [](MaterialMap& m) { m.objects[0][0].by_quadric = true; },
        [](MaterialMap& m) { m.objects[0][0].trees.clear(); },
        [](MaterialMap& m) { m.objects[0][0].trees[0].nodes.pop_back(); },
        [](MaterialMap& m) { m.objects[0][0].trees[0].nodes.emplace_back(); },
        [&](MaterialMap& m) { node(m, 0).low = 1; },
        [&](MaterialMap& m) { node(m, 2).high = 0; },
        [&](MaterialMap& m) { node(m, 0).axis = 3; },
        [&](MaterialMap& m) { node(m, 0).bits = 16; },
        [&](MaterialMap& m) { node(m, 0).offset = 2; },
        [&](MaterialMap& m) { node(m, 2).offset = -12; },
        [&](MaterialMap& m) { node(m, 2).tilt[0] = 5; },
        [&](MaterialMap& m) { node(m, 1).material = -1; },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_NE(flaw_after(changes[i]), "") << i;
}

}  // namespace
}  // namespace pfgeom
