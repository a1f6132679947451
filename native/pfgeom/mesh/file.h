// Mesh files: OBJ, PLY, STL and OFF, ascii and binary, polygons (triangulated) and triangle strips.
#pragma once

#include <string>

#include "pfgeom/mesh/triangle_mesh.h"

namespace pfgeom {

/// What a file holds. The format follows from the extension (any case).
/// Throws IoError (cannot be opened or read) and InvalidInput (what is wrong, with line or element number).
TriangleMesh read_mesh(const std::string& path);

/// Writes to a temporary name beside `path`, flushes and renames: the file is whole or absent.
/// PLY and STL binary, OBJ and OFF ascii with round-trip precision.
void write_mesh(const std::string& path, const TriangleMesh& mesh);

}  // namespace pfgeom
