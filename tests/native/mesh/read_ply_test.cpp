#include "mesh/text.h"
#include "pfgeom/mesh/formats.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using Faces = std::vector<Triangle>;
const std::vector<Vec3> kQuad{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string header(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\ncomment made by hand\n" + elements + "end_header\n";
}

const std::string kXyz = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";

TEST(ReadPly, AsciiInAnyOrderWithOtherPropertiesAndElements) {
    const TriangleMesh mesh =
        read_ply(bytes_of(header("ascii",
                                 "element camera 2\nproperty list uchar float view\nproperty int id\n"
                                 "element vertex 4\nproperty uchar red\nproperty double z\n"
                                 "property list uchar int ring\nproperty float y\nproperty float x\n"
                                 "element face 2\nproperty uchar flags\n"
                                 "property list uchar uint vertex_index\n") +
                          "2 0.5 0.5 7\n0 8\n"
                          "255 0 1 9 0 0\n255 0 0 0 1\n255 0 2 9 9 1 1\n255 0 0 1 0\n"
                          "1 3 0 1 2\n1 4 0 1 2 3\n"));
    EXPECT_EQ(mesh.vertices, kQuad);
    EXPECT_EQ(mesh.faces, Faces({{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadPly, BinaryOfBothByteOrders) {
    for (const bool big : {false, true}) {
        std::string text =
            header(big ? "binary_big_endian" : "binary_little_endian",
                   "element vertex 4\nproperty short x\nproperty double y\nproperty float z\n"
                   "element face 2\nproperty list ushort short vertex_indices\nproperty int tag\n");
        for (const Vec3& v : kQuad) {
            append_value(text, static_cast<std::int16_t>(v.x), big);
            append_value(text, v.y, big);
            append_value(text, static_cast<float>(v.z), big);
        }
        for (const std::vector<std::int16_t>& face : {std::vector<std::int16_t>{0, 1, 2, 3}, {2, 1, 0}}) {
            append_value(text, static_cast<std::uint16_t>(face.size()), big);
            for (const std::int16_t v : face) append_value(text, v, big);
            append_value(text, std::int32_t{-1}, big);
        }
        const TriangleMesh mesh = read_ply(bytes_of(text));
        EXPECT_EQ(mesh.vertices, kQuad);
        EXPECT_EQ(mesh.faces, Faces({{0, 1, 2}, {0, 2, 3}, {2, 1, 0}}));
    }
}

TEST(ReadPly, StripsTurnEverySecondTriangleAndRestart) {
    const TriangleMesh mesh = read_ply(
        bytes_of(header("ascii", kXyz + "element tristrips 1\nproperty list int int vertex_indices\n") +
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n13 0 1 3 2 -1 0 2 3 3 1 -1 -1 2\n"));
    EXPECT_EQ(mesh.faces, Faces({{0, 1, 3}, {3, 1, 2}, {0, 2, 3}}));
}

TEST(ReadPly, WindowsLineEnds) {
    std::string text = header("ascii", kXyz + kFaces) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\r\n");
    EXPECT_EQ(read_ply(bytes_of(text)).faces, Faces({{0, 1, 2}}));
}

TEST(ReadPly, RefusesCountsThatTheFileCannotHold) {
    const std::string many = "element vertex 4000000000\nproperty float x\n";
    EXPECT_NE(complaint(read_ply, header("ascii", many) + "0 0 0\n").find("room for"), std::string::npos);
    EXPECT_NE(complaint(read_ply, header("binary_little_endian", many)).find("room for"), std::string::npos);
    EXPECT_NE(complaint(read_ply, header("ascii", "element vertex -1\n")).find("line 4: a negative"),
              std::string::npos);
    std::string list =
        header("binary_little_endian", "element face 1\nproperty list uint int vertex_indices\n");
    append_value(list, 0xFFFFFFF0u);
    EXPECT_NE(complaint(read_ply, list).find("a list of 4294967280 values"), std::string::npos);
    // No properties: nothing to read, however many.
    EXPECT_TRUE(read_ply(bytes_of(header("ascii", "element ghost 9000000000000000000\n"))).faces.empty());
}

TEST(ReadPly, MaterialsOfFacesAndWhatIsNotTakenOver) {
    const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const std::string faces =
        "element face 2\nproperty int material_index\nproperty list uchar int vertex_indices\n";
    const auto with = [&](const std::string& rows) {
        return read_ply_file(bytes_of(header("ascii", kXyz + faces) + points + rows)).materials;
    };
    EXPECT_EQ(with("2 4 0 1 2 3\n0 3 0 1 2\n").of_face, (std::vector<std::int32_t>{2, 2, 0}));
    EXPECT_EQ(with("2 4 0 1 2 3\n0 3 0 1 2\n").names.size(), 3u);
    EXPECT_TRUE(with("-1 4 0 1 2 3\n0 3 0 1 2\n").none());
    EXPECT_TRUE(with("4096 4 0 1 2 3\n0 3 0 1 2\n").none());
    const LoadedMesh bare = read_ply_file(bytes_of(header("ascii", kXyz + kFaces) + points + "3 0 1 2\n"));
    EXPECT_TRUE(bare.materials.none());
    EXPECT_TRUE(bare.lost.empty());
    const std::string more =
        "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float s\nproperty uchar red\n";
    EXPECT_EQ(read_ply_file(bytes_of(header("ascii", more) + "0 0 0 1 0 255\n")).lost,
              (std::vector<std::string>{"texture coordinates", "normals", "colours"}));
}

TEST(ReadPly, NamesWhatIsWrong) {
    const std::string quad = header("ascii", kXyz + kFaces) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    EXPECT_EQ(complaint(read_ply, quad + "3 0 1 4\n").substr(0, 7), "face 0:");
    EXPECT_EQ(complaint(read_ply, quad + "3 0 1 -1\n").substr(0, 7), "face 0:");
    EXPECT_EQ(complaint(read_ply, quad + "3 0 one 2\n"), "line 15: a whole number is expected, not 'one'");
    EXPECT_NE(complaint(read_ply, quad + "3 0 1\n"), "");
    EXPECT_EQ(complaint(read_ply, "plx\n"), "line 1: a PLY file begins with 'ply'");
    EXPECT_EQ(complaint(read_ply, "ply\nformat ascii 1.0\n"), "line 3: the file ends within its header");
    EXPECT_EQ(complaint(read_ply, "ply\nend_header\n"), "line 2: the header names no format");
    EXPECT_EQ(complaint(read_ply, header("ascii", "element vertex 1\nproperty quad x\n")),
              "line 5: unknown type of a property");
    EXPECT_EQ(complaint(read_ply, header("ascii", "property float x\n")),
              "line 4: a property before the first element");
}

}  // namespace
}  // namespace pfgeom
