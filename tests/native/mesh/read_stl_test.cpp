#include "mesh/text.h"
#include "pfgeom/mesh/formats.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

std::string binary(std::string header, std::uint32_t announced, int facets) {
    header.resize(80, ' ');
    append_value(header, announced);
    for (int i = 0; i < facets; ++i) {
        for (const float value :
             {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, static_cast<float>(i)})
            append_value(header, value);
        header += "ab";
    }
    return header;
}

TEST(ReadStl, Binary) {
    for (const char* header : {"any", "solid but binary", "SOLID"}) {
        const TriangleMesh mesh = read_stl(bytes_of(binary(header, 3, 3)));
        ASSERT_EQ(mesh.vertices.size(), 9u);
        EXPECT_EQ(mesh.faces[2], (Triangle{6, 7, 8}));
        EXPECT_EQ(mesh.vertices[8], (Vec3{0, 1, 2}));
    }
}

TEST(ReadStl, BinaryWithBytesBehindAndCutShort) {
    EXPECT_EQ(read_stl(bytes_of(binary("solid", 2, 2) + "tail")).faces.size(), 2u);
    EXPECT_EQ(complaint(read_stl, binary("solid", 3, 2)),
              "the header announces 3 facets, the file has room for 2");
    EXPECT_NE(complaint(read_stl, binary("solid", 2, 2).substr(0, 150)), "");
}

const std::string kFacet =
    " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1e0 0\n  endloop\n "
    "endfacet\n";

TEST(ReadStl, AsciiWithSeveralSolidsInAnyCase) {
    EXPECT_EQ(
        read_stl(bytes_of("solid a b\n" + kFacet + kFacet + "endsolid a b\nsolid\n" + kFacet + "endsolid\n"))
            .faces,
        (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
    EXPECT_EQ(
        read_stl(
            bytes_of("SOLID A\r\nFACET NORMAL nan nan nan\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1 0 0\r\n"
                     "VERTEX 1 1 0\r\nVERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID"))
            .faces,
        (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadStl, NamesTheLineOfWhatIsWrong) {
    EXPECT_EQ(complaint(read_stl, "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 q\n"),
              "line 4: a number is expected, not 'q'");
    EXPECT_EQ(complaint(read_stl, "solid\nfacet\nouter loop\nvertex 0 0 0\n").substr(0, 7), "line 5:");
    EXPECT_EQ(complaint(read_stl, "hello world").substr(0, 7), "line 1:");
}

}  // namespace
}  // namespace pfgeom
