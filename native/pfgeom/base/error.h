// What the library throws. Bytes from outside never throw inside the library: they give a named FormatStatus
// (base/status.h), which the bindings turn into pfgeom.FormatError.
#pragma once

#include <stdexcept>

namespace pfgeom {

/// A precondition that the caller broke: the sentence names the offending row or value. (Python: ValueError)
struct InvalidInput : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// A file that cannot be opened, read or written. (Python: OSError)
struct IoError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The caller's cancel token was set. (Python: pfgeom.Cancelled)
struct Cancelled : std::runtime_error {
    Cancelled() : std::runtime_error("cancelled") {}
};

/// A cap of `Limits` would be exceeded by something that the caller asked for. (Python: pfgeom.LimitError)
struct LimitExceeded : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace pfgeom
