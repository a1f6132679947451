#include "mesh/text.h"
#include "pfgeom/mesh/formats.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

const std::vector<Vec3> kQuad{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kFaces{{0, 1, 2}, {0, 2, 3}};

TEST(ReadOff, Ascii) {
    for (const char* text : {
             "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
             "# first\nOFF # keyword\n\n# counts\n4 1 4\n0 0 0 # a\n1 0 0\n\n1 1 0\n# b\n0 1 0\n4 0 1 2 3",
             "off 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n",
             "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
             "COFF\n4 1 0\n0 0 0 255 0 0\n1 0 0 1 1 1 1\n1 1 0 9\n0 1 0\n4 0 1 2 3\n",
             "STCNOFF\r\n4 1 0\r\n0 0 0 1 2 3\r\n1 0 0 4\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3\r\n",
         }) {
        const TriangleMesh mesh = read_off(bytes_of(text));
        EXPECT_EQ(mesh.vertices, kQuad) << text;
        EXPECT_EQ(mesh.faces, kFaces) << text;
    }
}

TEST(ReadOff, BinaryIsBigEndian) {
    for (const int extra : {0, 3}) {
        std::string text = extra ? "NOFF BINARY\n" : "OFF BINARY\n";
        for (const std::int32_t count : {4, 2, 0}) append_value(text, count, true);
        for (const Vec3& v : kQuad) {
            for (const double x : {v.x, v.y, v.z}) append_value(text, static_cast<float>(x), true);
            for (int i = 0; i < extra; ++i) append_value(text, 9.f, true);
        }
        for (const Triangle& face : kFaces) {
            append_value(text, std::int32_t{3}, true);
            for (const std::int32_t v : face) append_value(text, v, true);
            append_value(text, std::int32_t{1}, true);
            append_value(text, 0.5f, true);
        }
        const TriangleMesh mesh = read_off(bytes_of(text));
        EXPECT_EQ(mesh.vertices, kQuad);
        EXPECT_EQ(mesh.faces, kFaces);
    }
}

TEST(ReadOff, NamesWhatIsWrong) {
    EXPECT_EQ(complaint(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").substr(0, 7), "line 6:");
    EXPECT_EQ(complaint(read_off, "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n").substr(0, 7), "line 4:");
    EXPECT_NE(complaint(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n").find("before face 0"),
              std::string::npos);
    EXPECT_NE(complaint(read_off, "OFF\n400000000 1 0\n0 0 0\n").find("room for"), std::string::npos);
    EXPECT_NE(complaint(read_off, "OFF\n-1 1 0\n"), "");
    EXPECT_NE(complaint(read_off, "4OFF\n1 0 0\n0 0 0 1\n").find("three coordinates"), std::string::npos);
    EXPECT_NE(complaint(read_off, ""), "");
    EXPECT_NE(complaint(read_off, "OFF BINARY\nab"), "");
}

}  // namespace
}  // namespace pfgeom
