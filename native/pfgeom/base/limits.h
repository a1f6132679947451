// Every default cap in one place, each with its reason.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pfgeom {

struct Limits {
    /// Files larger than this are refused before they are read.
    std::size_t file_bytes = std::size_t{1} << 30;
    /// Live memory of decoding: base + per_byte × file bytes, and never above 1 GiB.
    std::size_t decode_base_bytes = std::size_t{1} << 20;
    std::size_t decode_bytes_per_byte = std::size_t{16} << 10;
    /// Input meshes: indices are 32 bit.
    std::size_t vertices = std::size_t{1} << 27;
    std::size_t faces = std::size_t{1} << 28;
    /// Polygonizing: what one call may make.
    std::size_t polygon_cells = 100'000'000;
    std::size_t polygon_faces = 20'000'000;
    /// Pictures: 32 bytes a pixel, 2 GiB at most.
    int picture_side = 8192;
    /// Of a model's surface.
    std::size_t materials = 4096;
    /// Names and other strings, UTF-8.
    std::size_t string_bytes = 255;
};

}  // namespace pfgeom
