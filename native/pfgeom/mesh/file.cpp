#include "pfgeom/mesh/file.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/file.h"
#include "pfgeom/mesh/check.h"
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/text_scanner.h"

#include <array>
#include <string_view>

namespace pfgeom {
namespace {

struct Format {
    std::string_view extension;
    LoadedMesh (*read)(std::span<const std::uint8_t>);
    std::vector<std::uint8_t> (*write)(const TriangleMesh&, const FaceMaterials&);
};

// Formats that know of no materials.
template <TriangleMesh read(std::span<const std::uint8_t>)>
LoadedMesh read_plain(std::span<const std::uint8_t> bytes) {
    return {read(bytes), {}, {}};
}
template <std::vector<std::uint8_t> write(const TriangleMesh&)>
std::vector<std::uint8_t> write_plain(const TriangleMesh& mesh, const FaceMaterials&) {
    return write(mesh);
}

constexpr std::array<Format, 4> kFormats{{
    {".OBJ", read_obj_file, write_obj},
    {".PLY", read_ply_file, write_ply},
    {".STL", read_plain<read_stl>, write_plain<write_stl>},
    {".OFF", read_plain<read_off>, write_plain<write_off>},
}};

const Format& format_of(const std::string& path) {
    const std::string name = upper_case(path);
    for (const Format& format : kFormats)
        if (name.ends_with(format.extension)) return format;
    throw InvalidInput("'" + path + "': the name of a mesh file ends with .obj, .ply, .stl or .off");
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
    return read_mesh_file(path).mesh;
}

LoadedMesh read_mesh_file(const std::string& path) {
    const Format& format = format_of(path);
    const std::vector<std::uint8_t> bytes = read_file(path);
    try {
        return format.read(bytes);
    } catch (const InvalidInput& error) {
        throw InvalidInput("'" + path + "', " + error.what());
    }
}

void write_mesh(const std::string& path, const TriangleMesh& mesh, const FaceMaterials& materials) {
    const Format& format = format_of(path);
    check_indices(mesh);
    check_materials(materials, mesh.faces.size());
    write_file(path, format.write(mesh, materials));
}

}  // namespace pfgeom
