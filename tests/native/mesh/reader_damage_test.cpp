// Whatever a file holds, reading it gives a mesh with indices in range, or InvalidInput: every prefix, every
// changed byte, and many random changes of small files of each kind.
#include "mesh/text.h"
#include "pfgeom/base/random.h"
#include "pfgeom/mesh/check.h"
#include "pfgeom/mesh/formats.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Kind {
    const char* name;
    TriangleMesh (*read)(std::span<const std::uint8_t>);
    Bytes (*make)();
};

Bytes ascii_ply() {
    return bytes_of(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 3 2 1\n6 0 1 2 -1 1 2\n");
}

Bytes ascii_stl() {
    return bytes_of(
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid a\n");
}

Bytes binary_off() {
    std::string text = "OFF BINARY\n";
    for (const std::int32_t value : {3, 1, 0}) append_value(text, value, true);
    for (int i = 0; i < 9; ++i) append_value(text, static_cast<float>(i), true);
    for (const std::int32_t value : {3, 0, 1, 2, 0}) append_value(text, value, true);
    return bytes_of(text);
}

Bytes polygon_obj() {
    return bytes_of("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1/1/1 2//2 3/3 4 -1\nf 1 \\\n2 3\n");
}

const Kind kKinds[] = {
    {"obj", read_obj, [] { return write_obj(shapes::sphere(0)); }},
    {"obj with a polygon", read_obj, polygon_obj},
    {"off", read_off, [] { return write_off(shapes::sphere(0)); }},
    {"binary off", read_off, binary_off},
    {"ply", read_ply, [] { return write_ply(shapes::sphere(0)); }},
    {"ascii ply", read_ply, ascii_ply},
    {"stl", read_stl, [] { return write_stl(shapes::sphere(0)); }},
    {"ascii stl", read_stl, ascii_stl},
};

void expect_mesh_or_complaint(const Kind& kind, const Bytes& bytes) {
    try {
        const TriangleMesh mesh = kind.read(bytes);
        check_indices(mesh);
        EXPECT_LE(mesh.vertices.size() + mesh.faces.size(), 2 * bytes.size() + 2) << kind.name;
    } catch (const InvalidInput&) {
    }
}

TEST(ReaderDamage, TheUndamagedFilesAreRead) {
    for (const Kind& kind : kKinds) EXPECT_FALSE(kind.read(kind.make()).faces.empty()) << kind.name;
}

TEST(ReaderDamage, EveryPrefix) {
    for (const Kind& kind : kKinds) {
        const Bytes whole = kind.make();
        for (std::size_t n = 0; n < whole.size(); ++n)
            expect_mesh_or_complaint(kind,
                                     Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n)));
    }
}

TEST(ReaderDamage, EveryByteWithTellingValues) {
    for (const Kind& kind : kKinds) {
        Bytes bytes = kind.make();
        for (std::uint8_t& byte : bytes) {
            const std::uint8_t before = byte;
            const std::string telling = std::string("\n #-9\\/.e\x01\x7f\x80\xff\0", 14) +
                                        static_cast<char>(before ^ 1) + static_cast<char>(before ^ 128);
            for (const char value : telling) {
                byte = static_cast<std::uint8_t>(value);
                expect_mesh_or_complaint(kind, bytes);
            }
            byte = before;
        }
    }
}

TEST(ReaderDamage, ManyBytesAtRandom) {
    Random random(3);
    for (const Kind& kind : kKinds)
        for (int round = 0; round < 3000; ++round) {
            Bytes bytes = kind.make();
            const std::uint64_t changes = 1 + random.below(8);
            for (std::uint64_t i = 0; i < changes; ++i) {
                const std::size_t at = random.below(bytes.size());
                switch (random.below(3)) {
                    case 0:
                        bytes[at] = static_cast<std::uint8_t>(random.next());
                        break;
                    case 1:
                        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
                        break;
                    default:
                        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                     bytes[random.below(bytes.size())]);
                }
            }
            expect_mesh_or_complaint(kind, bytes);
        }
}

}  // namespace
}  // namespace pfgeom
