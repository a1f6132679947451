// OBJ and OFF, ascii, every coordinate in its shortest round-trip form.
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/text_writer.h"

#include <algorithm>
#include <string>

namespace pfgeom {

namespace {

// On one line.
std::string name_of(const FaceMaterials& materials, std::int32_t row) {
    std::string name = materials.names[static_cast<std::size_t>(row)];
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return name.empty() ? "material_" + std::to_string(row) : name;
}

}  // namespace

std::vector<std::uint8_t> write_obj(const TriangleMesh& mesh, const FaceMaterials& materials) {
    TextWriter out;
    for (const Vec3& v : mesh.vertices) out << "v " << v.x << " " << v.y << " " << v.z << "\n";
    std::int32_t last = -1;
    for (std::size_t row = 0; row < mesh.faces.size(); ++row) {
        if (!materials.of_face.empty() && materials.of_face[row] != last)
            out << "usemtl " << name_of(materials, last = materials.of_face[row]) << "\n";
        const auto& [i, j, k] = mesh.faces[row];
        out << "f " << std::int64_t{i} + 1 << " " << std::int64_t{j} + 1 << " " << std::int64_t{k} + 1
            << "\n";
    }
    return out.take();
}

std::vector<std::uint8_t> write_off(const TriangleMesh& mesh) {
    TextWriter out;
    out << "OFF\n"
        << static_cast<std::int64_t>(mesh.vertices.size()) << " "
        << static_cast<std::int64_t>(mesh.faces.size()) << " 0\n";
    for (const Vec3& v : mesh.vertices) out << v.x << " " << v.y << " " << v.z << "\n";
    for (const auto& [i, j, k] : mesh.faces)
        out << "3 " << std::int64_t{i} << " " << std::int64_t{j} << " " << std::int64_t{k} << "\n";
    return out.take();
}

}  // namespace pfgeom
