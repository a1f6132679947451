#include "mesh/text.h"
#include "pfgeom/mesh/formats.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

TriangleMesh read(std::string_view text) {
    return read_obj(bytes_of(text));
}

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
using Faces = std::vector<Triangle>;

TEST(ReadObj, TakesEveryFormOfACorner) {
    for (const char* face : {"f 1 2 3", "f 1/4 2/4 3/4", "f 1//9 2//9 3//9", "f 1/4/9 2/4/9 3/4/9",
                             "f -4 -3 -2", "f -4/-1 -3/-1 -2/-1", "  f\t1  2\t3  ", "f 1 2 3 # a comment",
                             "f 1 2 3\r", "f 1 \\\n2 3", "f 1 \\\r\n 2 3\r\n"})
        EXPECT_EQ(read(kCorners + face).faces, Faces({{0, 1, 2}})) << face;
}

TEST(ReadObj, TakesNumbersOfEveryForm) {
    const TriangleMesh mesh = read("v +1.5 -2e-3 1E+2\nv .5 -0 7. 1.0\nv 1 2 3 0.1 0.2 0.3\n");
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{1.5, -2e-3, 100}, {0.5, 0, 7}, {1, 2, 3}}));
}

TEST(ReadObj, PassesOverEverythingElse) {
    const TriangleMesh mesh = read("# comment\nmtllib a.mtl\no thing\n" + kCorners +
                                   "vn 0 0 1\nvt 0 0\nvp 1\ng a b\nusemtl m\ns off\nl 1 2\np 1\nf 1 2 3\n"
                                   "curv2 1 2 \\\n 3 4\nsomething 'else'\n\n");
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.faces, Faces({{0, 1, 2}}));
}

TEST(ReadObj, PolygonsBecomeTrianglesAndFacesMayComeFirst) {
    EXPECT_EQ(read("f 1 2 3 4\n" + kCorners).faces, Faces({{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(read(kCorners + "f 1 2\nf 3\nf\n").faces, Faces({{0, 1, 1}, {2, 2, 2}}));
}

TEST(ReadObj, NothingIsAMeshWithoutFaces) {
    EXPECT_TRUE(read("").vertices.empty());
    EXPECT_TRUE(read("\n\n# only this").faces.empty());
}

TEST(ReadObj, MaterialsOfFacesByName) {
    const auto file = [](const std::string& text) { return read_obj_file(bytes_of(kCorners + text)); };
    const FaceMaterials plain = file("f 1 2 3\n").materials;
    EXPECT_TRUE(plain.of_face.empty() && plain.names.empty());
    const FaceMaterials used = file(
                                   "f 1 2 3\nusemtl  red paint \r\nf 1 2 3 4\nusemtl b#2\nusemtl red "
                                   "paint\nf 1 2 3\nusemtl b#2\nf 2 3 4\n")
                                   .materials;
    EXPECT_EQ(used.of_face, (std::vector<std::int32_t>{0, 1, 1, 1, 2}));
    EXPECT_EQ(used.names, (std::vector<std::string>{"", "red paint", "b#2"}));
    EXPECT_EQ(file("usemtl a\xFF\nf 1 2 3\n").materials.names, std::vector<std::string>{"a?"});
    EXPECT_EQ(file("usemtl " + std::string(254, 'a') + "\xC3\xBC\nf 1 2 3\n").materials.names,
              std::vector<std::string>{std::string(254, 'a')});
}

TEST(ReadObj, SaysWhatIsNotTakenOver) {
    EXPECT_TRUE(read_obj_file(bytes_of(kCorners + "f 1 2 3\n")).lost.empty());
    EXPECT_EQ(read_obj_file(bytes_of("v 0 0 0 1 0.5 0\nvt 0 0\nvn 0 0 1\n" + kCorners + "f 1 2 3\n")).lost,
              (std::vector<std::string>{"texture coordinates", "normals", "colours"}));
}

TEST(ReadObj, NamesTheLineOfWhatIsWrong) {
    EXPECT_EQ(complaint(read_obj, "v 0 0 0\nv 1 x 0\n"), "line 2: a number is expected, not 'x'");
    EXPECT_EQ(complaint(read_obj, "v 0 0\n"), "line 1: a number is expected, not the line's end");
    EXPECT_EQ(complaint(read_obj, kCorners + "f 1 2 0\n"), "line 5: vertex index 0: the first vertex is 1");
    EXPECT_EQ(complaint(read_obj, kCorners + "\n\nf 1 2 5\n").substr(0, 7), "line 7:");
    EXPECT_EQ(complaint(read_obj, kCorners + "f -5 1 2\n").substr(0, 7), "line 5:");
    EXPECT_EQ(complaint(read_obj, kCorners + "f 1 2 a\n").substr(0, 7), "line 5:");
    EXPECT_EQ(complaint(read_obj, kCorners + "f 1 2 99999999999999\n").substr(0, 7), "line 5:");
    EXPECT_EQ(complaint(read_obj, kCorners + "f 1 2 \\\n 3\nf 4 5 6\n").substr(0, 7), "line 7:");
}

}  // namespace
}  // namespace pfgeom
