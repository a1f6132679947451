#include "pfgeom/mesh/file.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/file.h"
#include "scratch_folder.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace pfgeom {
namespace {

class MeshFile : public testing::Test {
  protected:
    std::string path(const std::string& extension) const { return folder_ / ("mesh" + extension); }

    TriangleMesh round_trip(const TriangleMesh& mesh, const std::string& extension) const {
        write_mesh(path(extension), mesh);
        return read_mesh(path(extension));
    }

    ScratchFolder folder_;
};

TEST_F(MeshFile, MaterialsGoIntoObjAndPlyAndComeBack) {
    const TriangleMesh mesh = shapes::sphere(1);
    FaceMaterials materials{{}, {"red", "", "two\nlines"}};
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        materials.of_face.push_back(static_cast<std::int32_t>(f % 3));
    for (const char* extension : {".obj", ".ply", ".stl", ".off"}) {
        write_mesh(path(extension), mesh, materials);
        const FaceMaterials back = read_mesh_file(path(extension)).materials;
        const std::string kind = extension;
        EXPECT_EQ(back.of_face,
                  kind == ".obj" || kind == ".ply" ? materials.of_face : std::vector<std::int32_t>{});
        if (kind == ".obj") {
            EXPECT_EQ(back.names, (std::vector<std::string>{"red", "material_1", "two lines"}));
        } else if (kind == ".ply") {
            EXPECT_EQ(back.names.size(), 3u);
        }
    }
    materials.of_face.pop_back();
    EXPECT_THROW(write_mesh(path(".obj"), mesh, materials), InvalidInput);
}

TEST_F(MeshFile, TextFormatsGiveBackTheSameBits) {
    TriangleMesh mesh = shapes::bumpy_sphere(3);
    mesh.vertices[0] = {1.0 / 3, -1e-300, 12345678.9012345678};
    for (const char* extension : {".obj", ".off", ".OFF", ".Obj"}) {
        const TriangleMesh again = round_trip(mesh, extension);
        EXPECT_EQ(again.vertices, mesh.vertices) << extension;
        EXPECT_EQ(again.faces, mesh.faces) << extension;
    }
}

TEST_F(MeshFile, PlyMovesNoVertexByMoreThanItsShare) {
    for (const double offset : {0.0, 1.0, 1e3, 1e6, 1e40}) {
        const TriangleMesh mesh = shapes::translated(shapes::bumpy_sphere(2), {offset, 0, 0});
        const TriangleMesh again = round_trip(mesh, ".ply");
        ASSERT_EQ(again.faces, mesh.faces);
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            EXPECT_LE(norm(again.vertices[i] - mesh.vertices[i]), 2e-7 * diagonal(mesh)) << offset;
    }
}

TEST_F(MeshFile, PlyIsSinglePrecisionWhereThatIsEnough) {
    const TriangleMesh mesh = shapes::sphere(3);
    round_trip(mesh, ".ply");
    EXPECT_LT(std::filesystem::file_size(path(".ply")),
              200 + 12 * mesh.vertices.size() + 13 * mesh.faces.size());
}

TEST_F(MeshFile, StlKeepsCornersAndOrderInSinglePrecision) {
    const TriangleMesh mesh = shapes::torus();
    const TriangleMesh again = round_trip(mesh, ".STL");
    ASSERT_EQ(again.faces.size(), mesh.faces.size());
    for (std::size_t i = 0; i < mesh.faces.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            EXPECT_LT(norm(again.vertices[3 * i + corner] - mesh.vertices[mesh.faces[i][corner]]), 1e-6);
    EXPECT_THROW(write_mesh(path(".stl"), shapes::sphere(0, 1e300)), InvalidInput);
}

TEST_F(MeshFile, EmptyMeshesAreFilesToo) {
    for (const char* extension : {".obj", ".ply", ".stl", ".off"})
        EXPECT_TRUE(round_trip({}, extension).faces.empty()) << extension;
}

TEST_F(MeshFile, RefusesWhatItCannotWriteOrRead) {
    EXPECT_THROW(read_mesh("a.gltf"), InvalidInput);
    EXPECT_THROW(write_mesh(path(".txt"), {}), InvalidInput);
    EXPECT_THROW(read_mesh(path(".missing.obj")), IoError);
    EXPECT_THROW(write_mesh(path(".obj"), TriangleMesh{{{0, 0, 0}}, {{0, 0, 1}}}), InvalidInput);
    EXPECT_THROW(write_mesh("/nowhere/a.obj", shapes::cube()), IoError);
}

TEST_F(MeshFile, TheMessageNamesFileAndLine) {
    const std::string text = "v 0 0 0\nv broken";
    write_file(path(".obj"), std::vector<std::uint8_t>(text.begin(), text.end()));
    try {
        read_mesh(path(".obj"));
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string(error.what()),
                  "'" + path(".obj") + "', line 2: a number is expected, not 'broken'");
    }
}

}  // namespace
}  // namespace pfgeom
