// What a file says about how close it is to what it was made from.
#pragma once

#include <cstdint>

namespace pfgeom {

enum class Metric : std::uint8_t { max, rms };

/// What the encoder promised and measured, in the mesh's units, rounded up where it matters. Of a
/// combination (function/combination.h): `promise_of` says what is known.
struct Promise {
    Metric metric = Metric::max;
    double tolerance = 0;    ///< what the user named
    double bound_mesh = 0;   ///< largest deviation between the input and the default mesh
    bool certified = false;  ///< bound_mesh is proved (else the largest of samples)
    double rms = 0;          ///< two-sided, the worse direction
    /// Largest deviation between the input and the surface of the functions themselves (of a mesh part: its
    /// mesh), of which the default mesh is an image; 0: not known.
    double bound_functions = 0;
    bool functions_certified = false;  ///< bound_functions is proved

    friend bool operator==(const Promise&, const Promise&) = default;
};

}  // namespace pfgeom
