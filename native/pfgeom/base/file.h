// Whole files of bytes: bounded reading, and writing that leaves the file whole or absent.
#pragma once

#include "pfgeom/base/limits.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pfgeom {

/// Throws IoError (cannot be opened or read, not a regular file, larger than limits.file_bytes).
std::vector<std::uint8_t> read_file(const std::string& path, const Limits& limits = {});
/// Temporary name beside `path`, flush to disk, rename. Throws IoError and leaves nothing behind.
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace pfgeom
