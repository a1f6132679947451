// Wavefront OBJ: v and f; normals, texture coordinates, groups, materials, lines and free-form statements are
// passed over. Indices count from 1, or backwards from the newest vertex if negative.
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/mesh_builder.h"
#include "pfgeom/mesh/text_scanner.h"

#include <string_view>

namespace pfgeom {
namespace {

/// "7", "7/1", "7//3" or "7/1/3" to a row of the vertices; only the first number matters here.
std::int64_t vertex_row(std::string_view word, std::int64_t vertices, const TextScanner& scanner) {
    std::int64_t index = 0;
    if (!parse(word.substr(0, word.find('/')), index)) scanner.fail("a face's corner is no vertex index");
    if (index == 0) scanner.fail("vertex index 0: the first vertex is 1");
    return index > 0 ? index - 1 : vertices + index;
}

}  // namespace

TriangleMesh read_obj(std::span<const std::uint8_t> bytes) {
    TextScanner scanner(bytes);
    MeshBuilder builder;
    std::vector<std::int64_t> corners;
    while (scanner.seek_word()) {
        const std::string_view keyword = scanner.word();
        if (keyword == "v") {
            const double x = scanner.number(), y = scanner.number(), z = scanner.number();
            builder.add_vertex({x, y, z});
        } else if (keyword == "f" || keyword == "fo") {  // fo: the same, of an early version
            const Place place{"line", scanner.line()};
            corners.clear();
            for (auto word = scanner.word(); !word.empty(); word = scanner.word())
                corners.push_back(vertex_row(word, builder.vertex_count(), scanner));
            builder.add_polygon(corners, place);
        }
        scanner.next_line();
    }
    return builder.finish();
}

}  // namespace pfgeom
