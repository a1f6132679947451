// Which material each face of a mesh has. Beside the mesh, not in it: most stages are about geometry alone.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pfgeom {

struct FaceMaterials {
    std::vector<std::int32_t> of_face;  ///< a row of `names` for each face; empty: all faces are alike
    std::vector<std::string> names;     ///< UTF-8, may be empty strings

    bool none() const { return of_face.empty() && names.empty(); }
};

struct PaintedMesh {
    TriangleMesh mesh;
    FaceMaterials materials;
};

/// A mesh as a file has it.
struct LoadedMesh {
    TriangleMesh mesh;
    FaceMaterials materials;
    std::vector<std::string> lost;  ///< what else the file says of the surface, in words: "normals"
};

/// A name as models hold it: bytes that are no UTF-8 become question marks, what is too long is cut.
std::string material_name(std::string_view text);

/// Throws InvalidInput: not one material a face, a row that does not exist, more of them than a model holds,
/// or names that are too long or no UTF-8.
void check_materials(const FaceMaterials& materials, std::size_t faces);

}  // namespace pfgeom
