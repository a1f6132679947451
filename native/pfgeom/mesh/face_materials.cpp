#include "pfgeom/mesh/face_materials.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/base/utf8.h"

#include <algorithm>

namespace pfgeom {

std::string material_name(std::string_view text) {
    std::string name(text.substr(0, Limits{}.string_bytes));
    if (!is_utf8(text)) {
        std::replace_if(
            name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }, '?');
    }
    while (!is_utf8(name)) name.pop_back();  // cut within a character
    return name;
}

void check_materials(const FaceMaterials& materials, std::size_t faces) {
    if (materials.none()) return;
    if (!materials.of_face.empty() && materials.of_face.size() != faces)
        throw InvalidInput("there are " + std::to_string(materials.of_face.size()) + " materials for " +
                           std::to_string(faces) + " faces");
    const std::size_t n = materials.names.size();
    if (n > Limits{}.materials) throw InvalidInput("there are more than 4096 materials");
    for (std::size_t row = 0; row < materials.of_face.size(); ++row) {
        const std::int32_t m = materials.of_face[row];
        if (m < 0 || static_cast<std::size_t>(m) >= n)
            throw InvalidInput("face " + std::to_string(row) + " has material " + std::to_string(m) +
                               ", there are " + std::to_string(n) + " (rows from 0)");
    }
    for (std::size_t row = 0; row < n; ++row) {
        if (materials.names[row].size() > Limits{}.string_bytes)
            throw InvalidInput("the name of material " + std::to_string(row) + " is longer than 255 bytes");
        if (!is_utf8(materials.names[row]))
            throw InvalidInput("the name of material " + std::to_string(row) + " is not UTF-8");
    }
}

}  // namespace pfgeom
