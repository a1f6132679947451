// STL, ascii and binary. Every facet has its own three vertices; prepare_mesh welds them. Normals and
// attribute bytes are passed over. Many binary files begin with "solid" as ascii files do, so the size
// decides.
#include "pfgeom/base/error.h"
#include "pfgeom/mesh/binary_scanner.h"
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/mesh_builder.h"
#include "pfgeom/mesh/text_scanner.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace pfgeom {
namespace {

constexpr std::size_t kHeaderBytes = 80, kFacetBytes = 50;

bool is_binary(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kHeaderBytes + 4) return false;
    BinaryScanner reader(bytes, false);
    reader.skip(kHeaderBytes);
    if (kHeaderBytes + 4 + kFacetBytes * std::size_t{reader.get<std::uint32_t>()} == bytes.size())
        return true;
    // Cut short or with something behind: text has no zero bytes, a count below 2^24 has one.
    const auto head = bytes.first(kHeaderBytes + 4);
    return std::find(head.begin(), head.end(), std::uint8_t{0}) != head.end();
}

TriangleMesh read_binary(std::span<const std::uint8_t> bytes) {
    BinaryScanner reader(bytes, false);
    reader.skip(kHeaderBytes);
    const auto count = reader.get<std::uint32_t>();
    if (count > reader.bytes_left() / kFacetBytes)
        throw InvalidInput("the header announces " + std::to_string(count) +
                           " facets, the file has room for " +
                           std::to_string(reader.bytes_left() / kFacetBytes));
    TriangleMesh mesh;
    mesh.vertices.reserve(3 * std::size_t{count});
    mesh.faces.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        reader.skip(12);  // the normal
        const auto row = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.faces.push_back({row, row + 1, row + 2});
        for (int corner = 0; corner < 3; ++corner) {
            const auto x = reader.get<float>(), y = reader.get<float>(), z = reader.get<float>();
            mesh.vertices.push_back({x, y, z});
        }
        reader.skip(2);  // attributes
    }
    return mesh;
}

TriangleMesh read_ascii(std::span<const std::uint8_t> bytes) {
    TextScanner scanner(bytes);
    MeshBuilder builder;
    std::vector<std::int64_t> loop;
    while (scanner.seek_word()) {
        const std::string keyword = upper_case(scanner.word());
        if (keyword == "VERTEX") {
            const double x = scanner.number(), y = scanner.number(), z = scanner.number();
            loop.push_back(builder.vertex_count());
            builder.add_vertex({x, y, z});
        } else if (keyword == "ENDLOOP") {
            builder.add_polygon(loop, {"line", scanner.line()});
            loop.clear();
        } else if (keyword == "SOLID" || keyword == "ENDSOLID" || keyword == "FACET") {
            scanner.next_line();  // a name or a normal
        } else if (keyword != "OUTER" && keyword != "LOOP" && keyword != "ENDFACET") {
            scanner.fail("neither a word of ascii STL nor a binary file of the right size");
        }
    }
    if (!loop.empty()) scanner.fail("the file ends within a facet");
    return builder.finish();
}

}  // namespace

TriangleMesh read_stl(std::span<const std::uint8_t> bytes) {
    return is_binary(bytes) ? read_binary(bytes) : read_ascii(bytes);
}

}  // namespace pfgeom
