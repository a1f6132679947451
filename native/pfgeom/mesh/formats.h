// The readers and writers behind mesh/file.h, a source file each. Readers throw InvalidInput with the line or
// element; what they allocate is bounded by the bytes that they were given.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

TriangleMesh read_obj(std::span<const std::uint8_t> bytes);
TriangleMesh read_off(std::span<const std::uint8_t> bytes);
TriangleMesh read_ply(std::span<const std::uint8_t> bytes);
TriangleMesh read_stl(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> write_obj(const TriangleMesh& mesh);
std::vector<std::uint8_t> write_off(const TriangleMesh& mesh);
std::vector<std::uint8_t> write_ply(const TriangleMesh& mesh);
std::vector<std::uint8_t> write_stl(const TriangleMesh& mesh);

}  // namespace pfgeom
