// OBJ and OFF, ascii, every coordinate in its shortest round-trip form.
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/text_writer.h"

namespace pfgeom {

std::vector<std::uint8_t> write_obj(const TriangleMesh& mesh) {
    TextWriter out;
    for (const Vec3& v : mesh.vertices) out << "v " << v.x << " " << v.y << " " << v.z << "\n";
    for (const auto& [i, j, k] : mesh.faces)
        out << "f " << std::int64_t{i} + 1 << " " << std::int64_t{j} + 1 << " " << std::int64_t{k} + 1
            << "\n";
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
