// The header of a PLY file: which elements follow, how often, and of which properties.
#pragma once

#include "pfgeom/mesh/text_scanner.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pfgeom {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t byte_size(PlyType type);

struct PlyProperty {
    std::string name;
    bool list = false;
    PlyType count_type = PlyType::uint8;  // of a list
    PlyType type = PlyType::float32;
};

struct PlyElement {
    std::string name;
    std::int64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
};

/// Leaves the scanner behind the header. Throws InvalidInput with the line.
PlyHeader read_ply_header(TextScanner& scanner);

}  // namespace pfgeom
