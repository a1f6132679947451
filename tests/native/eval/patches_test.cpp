#include "pfgeom/eval/patches.h"

#include "pfgeom/base/error.h"
#include "pfgeom/eval/edge_axes.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/function/curved_triangle.h"
#include "pfgeom/function/edges_of_faces.h"
#include "pfgeom/mesh/bvh.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pfgeom {
namespace {

constexpr double kStep = 1.0 / 1024;  // of the parts below

// On a grid of kStep, with the bulges that arcs of the unit sphere have.
Object sphere_part(int level) {
    MeshPart part;
    part.step_code = part.bulge_code = -80;
    const TriangleMesh mesh = shapes::sphere(level);
    part.faces = mesh.faces;
    for (const Vec3& v : mesh.vertices) {
        const auto round = [](double x) { return static_cast<std::int32_t>(std::floor(x / kStep + 0.5)); };
        part.positions.push_back({round(v.x), round(v.y), round(v.z)});
    }
    for (const auto& [a, b] : EdgesOfFaces::of(part.faces).ends) {
        const double half =
            norm(mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)]) / 2;
        part.bulges.push_back({static_cast<std::int32_t>(std::floor((1 - half) / kStep + 0.5)), 0});
    }
    Object object;
    object.shape = part;
    return object;
}

// Of the vertices of one mesh from the other.
double worst_distance(const TriangleMesh& from, const TriangleMesh& to) {
    const Bvh bvh(to);
    double worst = 0;
    for (const Vec3& v : from.vertices) worst = std::max(worst, bvh.closest(v).squared_distance);
    return std::sqrt(worst);
}

TEST(Patches, BulgedOctahedronIsNearlyASphere) {
    for (const Vec3& v : divide_patches(sphere_part(1), {.chord = 1e-3}).vertices)
        EXPECT_NEAR(norm(v), 1, 0.02);
}

TEST(Patches, DividedMeshIsClosedWhateverItsEdgesAre) {
    Object object = sphere_part(1);
    auto& part = std::get<MeshPart>(object.shape);
    for (std::size_t i = 0; i < part.bulges.size(); i += 3) part.bulges[i] = {};  // these are not divided
    part.bulges[1].normal *= 5;
    for (const double chord : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const TriangleMesh mesh = divide_patches(object, {.chord = chord});
        std::map<std::pair<int, int>, int> sides;
        for (const Triangle& t : mesh.faces) {
            for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
        }
        for (const auto& [side, uses] : sides) {
            EXPECT_EQ(uses, 1);
            EXPECT_EQ(sides.count({side.second, side.first}), 1U);
        }
    }
}

TEST(Patches, ChordHoldsBesideStraightEdgesToo) {
    Object object = sphere_part(0);
    auto& part = std::get<MeshPart>(object.shape);
    for (std::size_t i = 0; i < part.bulges.size(); i += 3) part.bulges[i] = {};
    for (const double chord : {4e-3, 1e-3}) {
        const TriangleMesh fine = divide_patches(object, {.chord = 1e-5});
        EXPECT_LT(worst_distance(fine, divide_patches(object, {.chord = chord})), 2 * chord);
    }
}

TEST(Patches, ChordSaysHowFarEdgesAreFromTheirCurve) {
    const Object object = sphere_part(0);
    const TriangleMesh fine = divide_patches(object, {.chord = 1e-6}),
                       coarse = divide_patches(object, {.chord = 1e-2});
    EXPECT_LT(coarse.faces.size() * 20, fine.faces.size());
    EXPECT_LT(worst_distance(fine, coarse), 1.5e-2);
    EXPECT_GT(worst_distance(fine, coarse), 2e-3);
}

// A unit square bent about its y axis: rows of two triangles each, and not a lattice, between its straight
// edges.
TEST(Patches, NeedsHardlyAVertexWithinACylinder) {
    MeshPart part;
    part.step_code = part.bulge_code = -80;
    part.positions = {{0, 0, 0}, {1024, 0, 0}, {1024, 1024, 0}, {0, 1024, 0}};
    part.faces = {{0, 1, 2}, {0, 2, 3}};
    for (const auto& [a, b] : EdgesOfFaces::of(part.faces).ends) {
        const bool across =
            part.positions[static_cast<std::size_t>(a)][0] != part.positions[static_cast<std::size_t>(b)][0];
        part.bulges.push_back({across ? 256 : 0, 0});
    }
    Object object;
    object.shape = part;
    const double bulge = 256 * part.bulge_step();
    for (const int parts : {2, 5, 8, 16}) {
        const double chord = 1.001 * bulge / (parts * parts);
        const TriangleMesh mesh = divide_patches(object, {.chord = chord});
        const std::size_t rows = 2 * (2 * static_cast<std::size_t>(parts) - 1);
        EXPECT_LE(mesh.faces.size(), rows + rows / 8) << parts;  // two lattices have parts² each
        EXPECT_LT(worst_distance(divide_patches(object, {.chord = 1e-6}), mesh), chord);
    }
    const TriangleMesh even = divide_patches(object, {.chord = 1, .length = 0.1});
    EXPECT_GT(even.faces.size(), 200U) << "lengths hold in both directions";
}

TEST(Patches, TangentTouchesTheSurface) {
    const CurvedTriangle patch{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                               {{{0, 0, 0.1}, {0.1, 0.1, 0}, {0, 0, -0.2}}}};
    const Vec3 w{0.2, 0.5, 0.3}, step{1e-4, -3e-4, 2e-4};
    const auto t = patch.tangent(w);
    const auto on_plane = [&](const Vec3& x) { return t[0] * x.x + t[1] * x.y + t[2] * x.z; };
    EXPECT_LT(norm(on_plane(w) - patch.at(w)), 1e-12);
    EXPECT_LT(norm(on_plane(w + step) - patch.at(w + step)), 1e-6);
    EXPECT_GT(norm(on_plane({1, 0, 0}) - patch.at({1, 0, 0})), 1e-2);
}

TEST(Patches, AxesDoNotDependOnTheOrderOfFaces) {
    for (const TriangleMesh& mesh : {shapes::moebius(), shapes::edge_fan(), shapes::misoriented_sphere()}) {
        MeshPart part;
        for (const Vec3& v : mesh.vertices)
            part.positions.push_back({static_cast<std::int32_t>(1000 * v.x),
                                      static_cast<std::int32_t>(1000 * v.y),
                                      static_cast<std::int32_t>(1000 * v.z)});
        part.faces = mesh.faces;
        MeshPart turned = part;
        std::reverse(turned.faces.begin(), turned.faces.end());
        for (Triangle& t : turned.faces) t = {t[1], t[2], t[0]};
        const EdgesOfFaces edges = EdgesOfFaces::of(part.faces), others = EdgesOfFaces::of(turned.faces);
        const std::vector<EdgeAxes> axes = edge_axes(part, edges), other_axes = edge_axes(turned, others);
        std::map<std::pair<int, int>, std::size_t> row;
        for (std::size_t i = 0; i < others.ends.size(); ++i)
            row[std::minmax(others.ends[i][0], others.ends[i][1])] = i;
        for (std::size_t i = 0; i < edges.ends.size(); ++i) {
            const EdgeAxes& o = other_axes[row.at(std::minmax(edges.ends[i][0], edges.ends[i][1]))];
            EXPECT_EQ(axes[i].normal, o.normal);
            EXPECT_EQ(axes[i].sideways, o.sideways);
        }
    }
}

TEST(Patches, FieldIsTheSignedDistanceToTheCurvedSurface) {
    Model model;
    model.diagonal = 4;
    model.objects = {sphere_part(1)};
    model.objects[0].mesh_code = 40;
    const ModelField field(model);
    EXPECT_NEAR(field.value({0, 0, 0.5}), 0.5, 0.02);
    EXPECT_NEAR(field.value({0.8, 0.8, 0.8}), 1 - 0.8 * std::sqrt(3.0), 0.02);
}

TEST(Patches, RefusesMoreTrianglesThanAMeshMayHave) {
    Object object = sphere_part(6);
    for (Bulge& b : std::get<MeshPart>(object.shape).bulges) b.normal = 1 << 26;
    EXPECT_THROW(divide_patches(object, {.chord = 1e-9}), LimitExceeded);
}

}  // namespace
}  // namespace pfgeom
