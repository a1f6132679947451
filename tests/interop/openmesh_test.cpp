// What OpenMesh, which shares no code with us, says of our files and of our meshes.

#include "pfgeom/compress/compress.h"
#include "pfgeom/mesh/mesh.h"
#include "scenes.h"
#include "scratch_folder.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include <string>

namespace {

using pfgeom::TriangleMesh;
using pfgeom::Vec3;

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

TriangleMesh scene(const std::string& name) {
    for (auto& s : scenes::all()) {
        if (s.name == name) return s.mesh;
    }
    ADD_FAILURE() << "no scene " << name;
    return {};
}

// Faces that OpenMesh refuses, since a half-edge would be used twice or a vertex become complex, are left
// out.
HalfEdgeMesh half_edges_of(const TriangleMesh& mesh) {
    HalfEdgeMesh result;
    for (const Vec3& v : mesh.vertices) result.add_vertex({v.x, v.y, v.z});
    for (const auto& face : mesh.faces) {
        result.add_face(result.vertex_handle(static_cast<unsigned>(face[0])),
                        result.vertex_handle(static_cast<unsigned>(face[1])),
                        result.vertex_handle(static_cast<unsigned>(face[2])));
    }
    return result;
}

double signed_volume(const HalfEdgeMesh& mesh) {
    double volume = 0;
    for (const auto face : mesh.faces()) {
        auto vertex = mesh.cfv_iter(face);
        const auto a = mesh.point(*vertex++), b = mesh.point(*vertex++), c = mesh.point(*vertex);
        volume += (a | (b % c)) / 6;
    }
    return volume;
}

double signed_volume(const TriangleMesh& mesh) {
    double volume = 0;
    for (const auto& [i, j, k] : mesh.faces) {
        const auto at = [&](std::int32_t row) { return mesh.vertices[static_cast<std::size_t>(row)]; };
        volume += dot(at(i), cross(at(j), at(k))) / 6;
    }
    return volume;
}

class Files : public testing::TestWithParam<const char*> {
  protected:
    std::string path() const { return folder_ / (std::string("torus.") + GetParam()); }

    pfgeom::ScratchFolder folder_;
};

TEST_P(Files, OpenMeshReadsWhatWeWrite) {
    const TriangleMesh torus = scene("torus");
    pfgeom::write_mesh(path(), torus);
    HalfEdgeMesh read;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(read, path()));
    EXPECT_EQ(read.n_faces(), torus.faces.size());
    EXPECT_NEAR(signed_volume(read), signed_volume(torus), 1e-5);
}

TEST_P(Files, WeReadWhatOpenMeshWrites) {
    const TriangleMesh torus = scene("torus");
    ASSERT_TRUE(OpenMesh::IO::write_mesh(half_edges_of(torus), path(), OpenMesh::IO::Options::Default, 17));
    const TriangleMesh read = pfgeom::read_mesh(path());
    EXPECT_EQ(read.faces.size(), torus.faces.size());
    EXPECT_NEAR(signed_volume(read), signed_volume(torus), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Formats, Files, testing::Values("obj", "ply", "stl", "off"));

class Manifold : public testing::TestWithParam<const char*> {};

TEST_P(Manifold, TheDefaultMeshOfAClosedShapeIsClosedForOpenMesh) {
    const auto compressed = pfgeom::compress(scene(GetParam()), {.tolerance = 2e-3});
    const TriangleMesh rebuilt = pfgeom::to_mesh(compressed.model);
    HalfEdgeMesh mesh = half_edges_of(rebuilt);

    EXPECT_EQ(mesh.n_faces(), rebuilt.faces.size()) << "OpenMesh refused faces: the mesh is not manifold";
    for (const auto edge : mesh.edges()) ASSERT_FALSE(mesh.is_boundary(edge));
    for (const auto vertex : mesh.vertices()) {
        ASSERT_FALSE(mesh.is_isolated(vertex));
        ASSERT_TRUE(mesh.is_manifold(vertex));
    }
    const auto euler = static_cast<std::ptrdiff_t>(mesh.n_vertices() + mesh.n_faces() - mesh.n_edges());
    EXPECT_EQ(euler, GetParam() == std::string("torus") ? 0 : 2);
    EXPECT_NEAR(signed_volume(mesh), signed_volume(scene(GetParam())), 0.02 * signed_volume(mesh));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Manifold, testing::Values("sphere", "ellipsoid", "cube", "torus", "pebble"));

}  // namespace
