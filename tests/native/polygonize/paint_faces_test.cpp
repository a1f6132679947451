#include "pfgeom/polygonize/paint_faces.h"

#include "codec/random_model.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/sample.h"
#include "polygonize/mesh_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <map>

namespace pfgeom {
namespace {

MaterialTree random_tree(std::uint64_t seed, int depth) {
    Random random(seed);
    MaterialTree tree;
    test::grow_material_tree(random, root_cell(), depth, 6, tree);
    return tree;
}

std::vector<std::int32_t> painted(TriangleMesh& mesh, const MaterialTree& tree, double snap) {
    const std::vector<const MaterialTree*> tree_of(mesh.faces.size(), &tree);
    return paint_faces(mesh, Frame{}, tree_of, snap, {});
}

// The share of the surface whose face has another material than the tree says.
double wrong_share(const TriangleMesh& mesh, const std::vector<std::int32_t>& materials,
                   const MaterialTree& tree) {
    const SurfaceSamples samples = sample_surface(mesh, 20'000, 3);
    int wrong = 0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        const auto face = static_cast<std::size_t>(samples.faces[i]);
        wrong += material_at(tree, samples.points[i]) != materials[face] ? 1 : 0;
    }
    return wrong / 20'000.0;
}

TEST(PaintFaces, CoarseFacesAreCutAlongTheBorders) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const MaterialTree tree = random_tree(seed, 5);
        for (TriangleMesh mesh :
             {shapes::cube(0.7), shapes::sphere(2, 0.8), shapes::torus(0.6, 0.2, 12, 8)}) {
            const TriangleMesh before = mesh;
            const std::vector<std::int32_t> materials = painted(mesh, tree, 1e-4);
            ASSERT_EQ(materials.size(), mesh.faces.size());
            EXPECT_LT(wrong_share(mesh, materials, tree), 2e-3) << seed;
            EXPECT_TRUE(test::is_closed_manifold(mesh)) << seed;
            EXPECT_NEAR(surface_area(mesh), surface_area(before), 1e-9 * surface_area(before));
            EXPECT_EQ(test::euler_characteristic(mesh), test::euler_characteristic(before));
        }
    }
}

TEST(PaintFaces, WhatIsPlainStaysAsItIs) {
    TriangleMesh mesh = shapes::sphere(3);
    const TriangleMesh before = mesh;
    MaterialTree tree;
    tree.nodes.resize(1);
    tree.nodes[0].material = 4;
    EXPECT_EQ(painted(mesh, tree, 1e-4), std::vector<std::int32_t>(before.faces.size(), 4));
    EXPECT_EQ(mesh.faces, before.faces);
    EXPECT_EQ(mesh.vertices, before.vertices);
}

// A border through a vertex or along an edge makes no slivers.
TEST(PaintFaces, BordersSnapToVerticesAndEdges) {
    MaterialTree tree;
    tree.nodes.resize(3);
    tree.nodes[0] = {.axis = 0, .bits = 12, .offset = 1, .high = 1, .low = 2, .normal = {}};  // x >= 1/4096
    derive(tree.nodes[0], root_cell());
    tree.nodes[2].material = 1;
    TriangleMesh mesh = shapes::sphere(2, 0.8);  // has vertices where x = 0
    const std::size_t before = mesh.faces.size();
    const auto materials = painted(mesh, tree, 1e-3);
    EXPECT_EQ(mesh.faces.size(), before);
    EXPECT_EQ(std::count(materials.begin(), materials.end(), 0), static_cast<std::ptrdiff_t>(before / 2));
}

// Every face its own tree: neighbours of different materials share their vertices all the same.
TEST(PaintFaces, TreesOfNeighboursMayDiffer) {
    TriangleMesh mesh = shapes::sphere(1, 0.8);
    const MaterialTree a = random_tree(1, 4), b = random_tree(2, 4);
    std::vector<const MaterialTree*> tree_of;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) tree_of.push_back(f % 2 == 0 ? &a : &b);
    paint_faces(mesh, Frame{}, tree_of, 1e-4, {});
    EXPECT_TRUE(test::is_closed_manifold(mesh));
}

TEST(PaintFaces, OpenAndNonManifoldMeshesStayTogether) {
    for (TriangleMesh mesh : {shapes::edge_fan(5), shapes::saddle(4), shapes::moebius(12)}) {
        const MaterialTree tree = random_tree(4, 5);
        const auto before = EdgeTable(mesh.faces, mesh.vertices.size()).boundary().size();
        const double length = surface_area(mesh);
        painted(mesh, tree, 1e-4);
        EXPECT_NEAR(surface_area(mesh), length, 1e-9 * length);
        // Borders are divided, not torn: no edge inside has lost its partner.
        std::map<std::size_t, int> uses;
        EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> u) {
            ++uses[u.size()];
        });
        EXPECT_GE(uses[1], static_cast<int>(before) > 0 ? 1 : 0);
        EXPECT_EQ(uses.count(4), 0U);
    }
}

TEST(PaintFaces, DoesNotDependOnThreads) {
    const MaterialTree tree = random_tree(9, 6);
    TriangleMesh one = shapes::sphere(4, 0.9), many = one;
    const std::vector<const MaterialTree*> tree_of(one.faces.size(), &tree);
    Task single, several;
    single.threads = 1, several.threads = 4;
    EXPECT_EQ(paint_faces(one, Frame{}, tree_of, 1e-4, single),
              paint_faces(many, Frame{}, tree_of, 1e-4, several));
    EXPECT_EQ(one.vertices, many.vertices);
    EXPECT_EQ(one.faces, many.faces);
}

}  // namespace
}  // namespace pfgeom
