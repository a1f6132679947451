// Wavefront OBJ: v, f and usemtl; normals and texture coordinates are counted as lost, groups, lines and
// free-form statements passed over. Indices count from 1, or backwards from the newest vertex if negative.
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/mesh_builder.h"
#include "pfgeom/mesh/text_scanner.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace pfgeom {
namespace {

/// "7", "7/1", "7//3" or "7/1/3" to a row of the vertices; only the first number matters here.
std::int64_t vertex_row(std::string_view word, std::int64_t vertices, const TextScanner& scanner) {
    std::int64_t index = 0;
    if (!parse(word.substr(0, word.find('/')), index)) scanner.fail("a face's corner is no vertex index");
    if (index == 0) scanner.fail("vertex index 0: the first vertex is 1");
    return index > 0 ? index - 1 : vertices + index;
}

/// The materials of a file's faces, as usemtl names them; those before the first have one without a name.
class UsedMaterials {
  public:
    void use(std::string_view text) {
        while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
        while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
        const std::string name = material_name(text);
        const auto [at, fresh] = rows_.try_emplace(name, static_cast<std::int32_t>(rows_.size()));
        if (fresh) materials_.names.push_back(name);
        current_ = at->second;
        named_ = true;
    }
    void add_faces(std::size_t up_to) {
        if (current_ < 0) {
            use("");
            named_ = false;
        }
        materials_.of_face.resize(up_to, current_);
    }
    FaceMaterials take() { return named_ ? std::move(materials_) : FaceMaterials{}; }

  private:
    std::map<std::string, std::int32_t> rows_;
    FaceMaterials materials_;
    std::int32_t current_ = -1;
    bool named_ = false;  // is there a usemtl?
};

}  // namespace

LoadedMesh read_obj_file(std::span<const std::uint8_t> bytes) {
    TextScanner scanner(bytes);
    MeshBuilder builder;
    UsedMaterials materials;
    bool coordinates = false, normals = false, colours = false;
    std::vector<std::int64_t> corners;
    while (scanner.seek_word()) {
        const std::string_view keyword = scanner.word();
        if (keyword == "v") {
            const double x = scanner.number(), y = scanner.number(), z = scanner.number();
            builder.add_vertex({x, y, z});
            if (!scanner.word().empty() && !scanner.word().empty()) colours = true;  // one more is a weight
        } else if (keyword == "vt") {
            coordinates = true;
        } else if (keyword == "vn") {
            normals = true;
        } else if (keyword == "f" || keyword == "fo") {  // fo: the same, of an early version
            const Place place{"line", scanner.line()};
            corners.clear();
            for (auto word = scanner.word(); !word.empty(); word = scanner.word())
                corners.push_back(vertex_row(word, builder.vertex_count(), scanner));
            builder.add_polygon(corners, place);
            materials.add_faces(builder.face_count());
        } else if (keyword == "usemtl") {
            materials.use(scanner.rest_of_line());
            continue;
        }
        scanner.next_line();
    }
    LoadedMesh file{builder.finish(), materials.take(), {}};
    if (coordinates) file.lost.emplace_back("texture coordinates");
    if (normals) file.lost.emplace_back("normals");
    if (colours) file.lost.emplace_back("colours");
    return file;
}

}  // namespace pfgeom
