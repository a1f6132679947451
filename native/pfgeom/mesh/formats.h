// The readers and writers behind mesh/file.h, a source file each. Readers throw InvalidInput with the line or
// element; what they allocate is bounded by the bytes that they were given.
#pragma once

#include "pfgeom/mesh/face_materials.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

LoadedMesh read_obj_file(std::span<const std::uint8_t> bytes);
LoadedMesh read_ply_file(std::span<const std::uint8_t> bytes);
inline TriangleMesh read_obj(std::span<const std::uint8_t> bytes) {
    return read_obj_file(bytes).mesh;
}
inline TriangleMesh read_ply(std::span<const std::uint8_t> bytes) {
    return read_ply_file(bytes).mesh;
}
TriangleMesh read_off(std::span<const std::uint8_t> bytes);
TriangleMesh read_stl(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> write_obj(const TriangleMesh& mesh, const FaceMaterials& materials = {});
std::vector<std::uint8_t> write_off(const TriangleMesh& mesh);
std::vector<std::uint8_t> write_ply(const TriangleMesh& mesh, const FaceMaterials& materials = {});
std::vector<std::uint8_t> write_stl(const TriangleMesh& mesh);

}  // namespace pfgeom
