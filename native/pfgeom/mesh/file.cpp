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
    TriangleMesh (*read)(std::span<const std::uint8_t>);
    std::vector<std::uint8_t> (*write)(const TriangleMesh&);
};

constexpr std::array<Format, 4> kFormats{{
    {".OBJ", read_obj, write_obj},
    {".PLY", read_ply, write_ply},
    {".STL", read_stl, write_stl},
    {".OFF", read_off, write_off},
}};

const Format& format_of(const std::string& path) {
    const std::string name = upper_case(path);
    for (const Format& format : kFormats)
        if (name.ends_with(format.extension)) return format;
    throw InvalidInput("'" + path + "': the name of a mesh file ends with .obj, .ply, .stl or .off");
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
    const Format& format = format_of(path);
    const std::vector<std::uint8_t> bytes = read_file(path);
    try {
        return format.read(bytes);
    } catch (const InvalidInput& error) {
        throw InvalidInput("'" + path + "', " + error.what());
    }
}

void write_mesh(const std::string& path, const TriangleMesh& mesh) {
    const Format& format = format_of(path);
    check_indices(mesh);
    write_file(path, format.write(mesh));
}

}  // namespace pfgeom
