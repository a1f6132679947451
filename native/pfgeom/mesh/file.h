// Mesh files: OBJ, PLY, STL and OFF, ascii and binary, polygons (triangulated) and triangle strips. The
// readers are our own: OpenMesh's take non-manifold faces apart, know no strips, guess where a file is
// damaged, and end the process on a count that is too large (docs/MESHES.md has the cases).
#pragma once

#include "pfgeom/mesh/face_materials.h"

#include <string>

namespace pfgeom {

/// What a file holds. The format follows from the extension (any case).
/// Throws IoError (cannot be opened or read) and InvalidInput (what is wrong, with line or element number).
TriangleMesh read_mesh(const std::string& path);

/// The same with the materials of its faces (OBJ: usemtl; PLY: the faces' property material_index), and with
/// what else is said of the surface, which is not taken over.
LoadedMesh read_mesh_file(const std::string& path);

/// Writes to a temporary name beside `path`, flushes and renames: the file is whole or absent.
/// PLY and STL binary, OBJ and OFF ascii with round-trip precision.
/// Materials go into OBJ and PLY files, these without names.
void write_mesh(const std::string& path, const TriangleMesh& mesh, const FaceMaterials& materials = {});

}  // namespace pfgeom
