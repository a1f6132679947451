// The public header of the file format: Model <-> bytes (docs/FORMAT.md). The only code that reads hostile
// input.
#pragma once

#include "pfgeom/base/limits.h"
#include "pfgeom/base/status.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pfgeom {

/// Canonical: equal models give equal bytes.
std::vector<std::uint8_t> encode(const Model& model);

/// Any bytes give a model or a named status: no crash, no hang, memory within `limits`.
Result<Model> decode(std::span<const std::uint8_t> bytes, const Limits& limits = {});

/// Where the bytes of an encoded model went, for `info` and reports.
struct SizeReport {
    std::size_t total = 0, head = 0;      ///< head: all that is neither functions nor mesh parts
    std::vector<double> bytes_of_object;  ///< estimated: objects share one stream
    std::vector<double> bytes_of_level;   ///< by depth, over all objects
};
SizeReport measure_size(const Model& model);

}  // namespace pfgeom
