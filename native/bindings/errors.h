// What the bindings throw beside the library's own exceptions.
#pragma once

#include "pfgeom/base/status.h"

#include <exception>
#include <stdexcept>
#include <string>

namespace pfgeom::bindings {

/// A status of the file format on its way to pfgeom.FormatError.
struct FormatFailure : std::runtime_error {
    explicit FormatFailure(FormatStatus s) : std::runtime_error(std::string(describe(s))), status(s) {}
    FormatStatus status;
};

}  // namespace pfgeom::bindings
